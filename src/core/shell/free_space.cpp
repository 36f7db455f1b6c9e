#include "core/shell/free_space.h"

#include "core/cloud/lattice.h"

#include <Eigen/Geometry>

#include <array>
#include <bitset>
#include <cmath>
#include <cstddef>

namespace grasp_affordances
{
namespace
{

/// Cosine and sine of the angles in the middles of equal parts of a circle.
template <std::size_t Parts>
std::array<Eigen::Vector2d, Parts> directionsAround()
{
  std::array<Eigen::Vector2d, Parts> directions;
  for (std::size_t i = 0; i < Parts; ++i) {
    const double angle = 2 * M_PI * (static_cast<double>(i) + 0.5) / Parts;
    directions[i] = {std::cos(angle), std::sin(angle)};
  }
  return directions;
}

}  // namespace

double observedFreeShare(const RangeImage& image, const ShellSearchResult& shell, const Eigen::Vector3d& axis,
                         const Eigen::Vector3d& normal, double thickness, const std::vector<OtherView>* others)
{
  constexpr int kAlong = 6, kAround = 24, kRadial = 2;
  static const auto kDirections = directionsAround<kAround>();
  const Eigen::Vector3d side = axis.cross(normal);
  std::array<Eigen::Vector3d, kAround * kRadial> ring;
  for (int b = 0; b < kAround; ++b) {
    const Eigen::Vector3d radial = kDirections[b].x() * normal + kDirections[b].y() * side;
    for (int c = 0; c < kRadial; ++c) {
      ring[b * kRadial + c] = (shell.inner_radius + thickness * (c + 0.5) / kRadial) * radial;
    }
  }
  constexpr std::size_t kPoints = kAlong * kAround * kRadial;
  Lattice<kPoints> lattice;
  for (int a = 0; a < kAlong; ++a) {
    const Eigen::Vector3d center = shell.centroid + shell.length * ((a + 0.5) / kAlong - 0.5) * axis;
    for (const Eigen::Vector3d& offset : ring) {
      lattice.add(center + offset);
    }
  }
  std::bitset<kPoints> free;
  const auto look = [&](const RangeImage& view) {
    lattice.visitMeasured(view, [&](std::size_t i, const Eigen::Vector3d& point, const Eigen::Vector3d& measured) {
      free[i] = free[i] || measured.squaredNorm() > point.squaredNorm();
    });
  };
  look(image);
  if (others != nullptr) {
    const Lattice<kPoints> own = lattice;
    for (const OtherView& other : *others) {
      if (other.image != nullptr) {
        lattice = own;
        lattice.transform(other.T_other_this);
        look(*other.image);
      }
    }
  }
  return static_cast<double>(free.count()) / kPoints;
}

double silhouetteCoverage(const RangeImage& image, const ShellSearchResult& shell, const Eigen::Vector3d& axis,
                          const Eigen::Vector3d& normal)
{
  constexpr int kAlong = 10, kAcross = 9;
  const Eigen::Vector3d side = axis.cross(normal);
  Lattice<kAlong * kAcross> lattice;
  for (int a = 0; a < kAlong; ++a) {
    const Eigen::Vector3d center = shell.centroid + shell.length * ((a + 0.5) / kAlong - 0.5) * axis;
    for (int b = 0; b < kAcross; ++b) {
      lattice.add(center + shell.inner_radius * (2 * (b + 0.5) / kAcross - 1.0) * side);
    }
  }
  int inside = 0, behind = 0;
  lattice.visitMeasured(image, [&](std::size_t, const Eigen::Vector3d& point, const Eigen::Vector3d& measured) {
    const Eigen::Vector3d offset = measured - shell.centroid;
    if ((offset - offset.dot(axis) * axis).norm() <= shell.inner_radius) {
      ++inside;
    } else if (measured.squaredNorm() > point.squaredNorm()) {
      ++behind;
    }
  });
  return inside + behind == 0 ? 0.0 : static_cast<double>(inside) / (inside + behind);
}

}  // namespace grasp_affordances
