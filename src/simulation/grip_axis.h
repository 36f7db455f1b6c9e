#pragma once

#include "simulation/primitive.h"

#include <Eigen/Geometry>

#include <functional>
#include <vector>

namespace grasp_affordances
{

/// A line that a hand can close around: an axis of a solid, straight or bent, and the solid's cross-sections at right
/// angles to it. Everything is in the solid's frame. A place on the axis is given by the distance from the start of the
/// axis, in m.
class GripAxis
{
public:
  enum class Section
  {
    elliptic,
    rectangular,
    rounded,  ///< a rectangle with rounded corners
    oval      ///< an ellipse that is judged by the circle around it
  };

  /// A straight axis along z of the given frame, whose origin is the middle of the axis. The sections are aligned with
  /// x and y. Their half sizes are the given ones times `scale(z)`. Maxima of that function are at the ends of the axis
  /// and at `peaks` (values of z).
  static GripAxis straight(const Eigen::Isometry3d& T_shape_axis, double length, Section section,
                           const Eigen::Vector2d& half_sizes, std::function<double(double)> scale = nullptr,
                           const std::vector<double>& peaks = {});
  static GripAxis along(const TorusArc& arc);
  static GripAxis along(const RoundedBox& box);

  double length() const { return length_; }
  bool closed() const { return closed_; }  ///< the axis ends where it starts
  Section section() const { return section_; }

  /// Frame of a section: origin on the axis, z along it, x and y in the directions of its half sizes.
  Eigen::Isometry3d sectionFrame(double place) const;
  Eigen::Vector2d halfSizes(double place) const;
  Eigen::Vector2d largestHalfSizes(double from, double to) const;

  /// Distance from the middle of a section of these half sizes to its outline.
  double outlineRadius(const Eigen::Vector2d& half_sizes, const Eigen::Vector2d& direction) const;

  /// Radius of a grip between two places: of the smallest circle around its sections if they are rounded or oval, else
  /// half the sections' larger size.
  double largestRadius(double from, double to) const;

  /// The place nearest to a point.
  double nearest(const Eigen::Vector3d& point) const;

private:
  Eigen::Isometry3d T_shape_axis_ = Eigen::Isometry3d::Identity();
  double bend_radius_ = 0.0;  ///< 0: straight; else the radius of an arc about that frame's z, with its middle on x
  double length_ = 0.0;
  bool closed_ = false;
  Section section_ = Section::elliptic;
  Eigen::Vector2d half_sizes_ = Eigen::Vector2d::Zero();
  double corner_radius_ = 0.0;  ///< of a rounded section
  std::function<double(double)> scale_;
  std::vector<double> peaks_;  ///< places
};

/// The axes of a solid. Most solids have one. A box and an ellipsoid have three, the longest first. A sphere has the
/// scene's vertical and two horizontal axes. A half-space has none.
std::vector<GripAxis> gripAxes(const Primitive& primitive, const Eigen::Matrix3d& R_scene_shape);

}  // namespace grasp_affordances
