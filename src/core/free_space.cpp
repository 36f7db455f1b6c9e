#include "grasp_affordances/free_space.h"

#include <Eigen/Geometry>

#include <cmath>

namespace grasp_affordances
{

double observedFreeShare(const RangeImage& image, const ShellSearchResult& shell, const Eigen::Vector3d& axis,
                         const Eigen::Vector3d& normal, double thickness)
{
  constexpr int kAlong = 6, kAround = 24, kRadial = 2;
  const Eigen::Vector3d side = axis.cross(normal);
  int free = 0;
  for (int a = 0; a < kAlong; ++a) {
    const double along = shell.length * ((a + 0.5) / kAlong - 0.5);
    for (int b = 0; b < kAround; ++b) {
      const double angle = 2 * M_PI * (b + 0.5) / kAround;
      const Eigen::Vector3d radial = std::cos(angle) * normal + std::sin(angle) * side;
      for (int c = 0; c < kRadial; ++c) {
        const double distance = shell.inner_radius + thickness * (c + 0.5) / kRadial;
        const Eigen::Vector3d point = shell.centroid + along * axis + distance * radial;
        const auto pixel = image.pixel(point);
        // False for NaN: nothing was measured there.
        free += pixel && image.cloud().point(*pixel).cast<double>().squaredNorm() > point.squaredNorm() ? 1 : 0;
      }
    }
  }
  return static_cast<double>(free) / (kAlong * kAround * kRadial);
}

double silhouetteCoverage(const RangeImage& image, const ShellSearchResult& shell, const Eigen::Vector3d& axis,
                          const Eigen::Vector3d& normal)
{
  constexpr int kAlong = 10, kAcross = 9;
  const Eigen::Vector3d side = axis.cross(normal);
  int inside = 0, behind = 0;
  for (int a = 0; a < kAlong; ++a) {
    const double along = shell.length * ((a + 0.5) / kAlong - 0.5);
    for (int b = 0; b < kAcross; ++b) {
      const double across = shell.inner_radius * (2 * (b + 0.5) / kAcross - 1.0);
      const Eigen::Vector3d point = shell.centroid + along * axis + across * side;
      const auto pixel = image.pixel(point);
      if (!pixel || !image.cloud().measured(*pixel)) {
        continue;
      }
      const Eigen::Vector3d measured = image.cloud().point(*pixel).cast<double>();
      const Eigen::Vector3d offset = measured - shell.centroid;
      if ((offset - offset.dot(axis) * axis).norm() <= shell.inner_radius) {
        ++inside;
      } else if (measured.squaredNorm() > point.squaredNorm()) {
        ++behind;
      }
    }
  }
  return inside + behind == 0 ? 0.0 : static_cast<double>(inside) / (inside + behind);
}

}  // namespace grasp_affordances
