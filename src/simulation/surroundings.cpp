#include "simulation/surroundings.h"

#include "simulation/placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

namespace grasp_affordances
{
namespace
{

constexpr std::size_t kDirections = 120;
constexpr std::array<double, 3> kSections = {1.0 / 6.0, 0.5, 5.0 / 6.0};  ///< shares of the way between the places
constexpr double kOffSurface = 1e-9;  ///< m; rays start so far outside the surface, in order not to hit it

std::array<Eigen::Vector2d, kDirections> directionsAround()
{
  std::array<Eigen::Vector2d, kDirections> directions;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * kPi * static_cast<double>(i) / kDirections;
    directions[i] = {std::cos(angle), std::sin(angle)};
  }
  return directions;
}

/// Width of the hole of a ring or an arc; infinite for other solids.
double holeWidth(const Primitive& primitive)
{
  const TorusArc* arc = std::get_if<TorusArc>(&primitive);
  return arc == nullptr ? kNoIntersection : 2.0 * (arc->major_radius - arc->tube_radius);
}

}  // namespace

Surroundings::Surroundings(const Scene& scene)
{
  for (const Part& part : scene.parts()) {
    solids_.push_back({&part.shape, part.T_scene_shape.inverse(), boundingBox(part.shape)});
  }
}

double Surroundings::clearance(std::size_t part, const GripAxis& axis, double from, double to,
                               const std::vector<std::size_t>& chain, double limit) const
{
  static const std::array<Eigen::Vector2d, kDirections> kAround = directionsAround();

  const Eigen::Isometry3d T_scene_shape = solids_[part].T_shape_scene.inverse();
  const Eigen::Vector3d middle = T_scene_shape * axis.sectionFrame(0.5 * (from + to)).translation();
  const double reach = std::hypot(axis.largestHalfSizes(from, to).norm() + limit, 0.5 * (to - from));
  double clearance = limit;
  for (std::size_t i = 0; i < solids_.size(); ++i) {
    const Solid& other = solids_[i];
    const bool own_far_side = i == part && holeWidth(*other.shape) < limit;
    if (!own_far_side && std::find(chain.begin(), chain.end(), i) != chain.end())
      continue;
    if (other.bounds.exteriorDistance(other.T_shape_scene * middle) > reach)
      continue;
    for (const double share : kSections) {
      const double place = from + share * (to - from);
      const Eigen::Isometry3d T_other_section = other.T_shape_scene * T_scene_shape * axis.sectionFrame(place);
      const Eigen::Vector2d half_sizes = axis.halfSizes(place);
      for (const Eigen::Vector2d& direction : kAround) {
        const double surface = axis.outlineRadius(half_sizes, direction) + kOffSurface;
        const Eigen::Vector3d outwards = T_other_section.linear().leftCols<2>() * direction;
        const Eigen::Vector3d start = T_other_section.translation() + surface * outwards;
        if (!own_far_side && contains(*other.shape, start))
          return 0.0;
        clearance = std::min(clearance, intersect(*other.shape, {start, outwards}));
      }
    }
  }
  return clearance;
}

}  // namespace grasp_affordances
