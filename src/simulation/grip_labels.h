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

/// A stretch of one part or of several in a chain that a hand can close around.
struct Grip
{
  std::uint32_t label = 0;            ///< 1..254
  std::vector<std::size_t> parts;     ///< that it lies on, in order
  double radius = 0.0;                ///< m, of the surface where it is widest
  double length = 0.0;                ///< m, along its axis
  std::vector<Eigen::Vector3d> axis;  ///< m, points along its axis, in the scene's frame
  std::vector<double> radii;          ///< m, of the surface at these points: half the section's larger size
  /// Of a ball, which can be gripped about any axis through it, in the scene's frame. A ball is a solid that tapers
  /// to less than half its width at both ends of an axis no longer than one and a half times that width.
  std::optional<Eigen::Vector3d> ball_center;
};

/// How far, in m, a radius, clearance or length has to be from its threshold to be certain, at a point of the scene.
using MarginAt = std::function<double(const Eigen::Vector3d& point_scene)>;

/// Where a scene's parts can be gripped, whoever sees them.
///
/// The axis of every part is cut into cells of about 4 mm, and each is judged by the largest radius of its surface and
/// its clearance. Runs of good cells that are long enough are grips; a chain's parts are one axis, on which a stretch
/// inside an earlier part adds no length. Doubtful are cells of runs that would be a grip if radius, clearance and
/// length erred by the margin, round ones that fit in but are too flat (their radius of curvature exceeds the capture
/// radius), and rectangular ones that fit in. Of a part's axes the first with a grip counts, else the first with
/// something doubtful.
class GripLabels
{
public:
  /// @throw std::length_error for a scene with more than 254 grips.
  GripLabels(const Scene& scene, const GraspDefinition& definition, const MarginAt& margin);

  const std::vector<Grip>& grips() const { return grips_; }  ///< by label

  /// Whether points of a part may have another label than 0: if not, all have 0.
  bool any(std::size_t part) const { return parts_[part].has_value(); }

  /// Label of a point of a part's surface: that of the nearest cell.
  std::uint32_t label(std::size_t part, const Eigen::Vector3d& point_shape) const;

private:
  struct Cells
  {
    GripAxis axis;
    std::vector<std::uint32_t> labels;
  };

  std::vector<std::optional<Cells>> parts_;  ///< none for parts on whose axis, or whose chain's, nothing was found
  std::vector<Grip> grips_;
};

}  // namespace grasp_affordances
