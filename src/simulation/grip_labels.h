#pragma once

#include "simulation/grasp_definition.h"
#include "simulation/grip_axis.h"
#include "simulation/scene.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace grasp_affordances
{

/// A section of a part, or of several parts of a chain, that a hand can close around.
struct Grip
{
  std::uint32_t label = 0;            ///< 1..254
  std::vector<std::size_t> parts;     ///< parts that it lies on, in order
  double radius = 0.0;                ///< m, largest radius of the surface
  double length = 0.0;                ///< m, along its axis
  std::vector<Eigen::Vector3d> axis;  ///< m, points along its axis, in the scene's frame
  std::vector<double> radii;          ///< m, of the surface at these points, see GripAxis::largestRadius()
  /// Centre of a ball, in the scene's frame; empty for other grips. A ball can be gripped about any axis through it. It
  /// is a solid whose axis is at most 1.5 times as long as the solid is wide, and that tapers to less than half of its
  /// width at both ends of the axis.
  std::optional<Eigen::Vector3d> ball_center;
};

/// The margin, in m, at a point of the scene. A radius, clearance or length is certain if it differs from its threshold
/// by at least the margin.
using MarginAt = std::function<double(const Eigen::Vector3d& point_scene)>;

/// Where a hand can grip the parts of a scene, whether a camera sees them or not.
///
/// The axis of every part is divided into cells of about 4 mm. A cell is good if the largest radius of its surface and
/// its clearance meet the definition. A long enough run of good cells is a grip. The parts of a chain have one common
/// axis; where a part lies inside an earlier one, its cells add no length.
///
/// These cells are doubtful:
///  - cells of a run that would be a grip if radius, clearance and length changed by the margin;
///  - round cells that fit into the hand but are too flat: their radius of curvature exceeds the capture radius;
///  - rectangular cells that fit into the hand;
///  - rounded and oval cells that fit, if every camera looks at their slim side: it is within 45 degrees of the
///    section's long axis, and the half sizes differ by the margin or more and by a factor of 1.2 or more;
///  - cells of a run in the background, with any clearance, that would be a grip without the margin or with it.
///
/// Of several axes of a part, the first one with a grip counts, or else the first one with doubtful cells.
class GripLabels
{
public:
  /// @throw std::length_error for a scene with more than 254 grips.
  /// @param cameras positions of the cameras that see the scene, in its frame; none: no section is doubtful because of
  /// the side that is seen
  GripLabels(const Scene& scene, const GraspDefinition& definition, const MarginAt& margin,
             const std::vector<Eigen::Vector3d>& cameras = {});

  const std::vector<Grip>& grips() const { return grips_; }  ///< by label

  /// Whether points of a part may have a label other than 0.
  bool any(std::size_t part) const { return parts_[part].has_value(); }

  /// Label of a point on a part's surface: the label of the nearest cell.
  std::uint32_t label(std::size_t part, const Eigen::Vector3d& point_shape) const;

private:
  struct Cells
  {
    GripAxis axis;
    std::vector<std::uint32_t> labels;
  };

  std::vector<std::optional<Cells>> parts_;  ///< empty for a part if nothing was found on its axis or its chain's axis
  std::vector<Grip> grips_;
};

}  // namespace grasp_affordances
