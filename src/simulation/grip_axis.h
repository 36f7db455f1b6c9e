#pragma once

#include "simulation/primitive.h"

#include <Eigen/Geometry>

#include <functional>
#include <vector>

namespace grasp_affordances
{

/// A line that a hand would close around: an axis of a solid, straight or bent, with the solid's sections at right
/// angles to it. Everything is in the solid's frame. A place on the axis is its distance from the axis' start, in m.
class GripAxis
{
public:
  enum class Section
  {
    elliptic,
    rectangular
  };

  /// Along z of the given frame, whose origin is the middle of the axis. The sections are aligned with x and y and have
  /// these half sizes times `scale(z)`, which has its maxima at the axis' ends and at those of `peaks` (values of z).
  static GripAxis straight(const Eigen::Isometry3d& T_shape_axis, double length, Section section,
                           const Eigen::Vector2d& half_sizes, std::function<double(double)> scale = nullptr,
                           const std::vector<double>& peaks = {});
  static GripAxis along(const TorusArc& arc);

  double length() const { return length_; }
  bool closed() const { return closed_; }  ///< the end is the start
  Section section() const { return section_; }

  /// The section's frame: origin on the axis, z along it, x and y the directions of its half sizes.
  Eigen::Isometry3d sectionFrame(double place) const;
  Eigen::Vector2d halfSizes(double place) const;
  Eigen::Vector2d largestHalfSizes(double from, double to) const;

  /// The place nearest to a point.
  double nearest(const Eigen::Vector3d& point) const;

private:
  Eigen::Isometry3d T_shape_axis_ = Eigen::Isometry3d::Identity();
  double bend_radius_ = 0.0;  ///< 0: straight; else of an arc about z of that frame, with its middle on x
  double length_ = 0.0;
  bool closed_ = false;
  Section section_ = Section::elliptic;
  Eigen::Vector2d half_sizes_ = Eigen::Vector2d::Zero();
  std::function<double(double)> scale_;
  std::vector<double> peaks_;  ///< places
};

/// Distance from the middle of a section to its outline.
double outlineRadius(GripAxis::Section section, const Eigen::Vector2d& half_sizes, const Eigen::Vector2d& direction);

/// The axes of a solid, one for most. A box has three and an ellipsoid its principal ones, the longest first; a sphere
/// the scene's vertical and two horizontal ones; a half-space none.
std::vector<GripAxis> gripAxes(const Primitive& primitive, const Eigen::Matrix3d& R_scene_shape);

}  // namespace grasp_affordances
