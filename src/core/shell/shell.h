#pragma once

#include "core/neighborhoods/surroundings.h"
#include "grasp_affordances/config.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>

namespace grasp_affordances
{

/// The cylinder that was fitted to a neighborhood. The shell search starts from its axis and radius.
struct FittedCylinder
{
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m, projection of the sample onto the axis
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< unit
  double radius = 0.0;                               ///< m
};

/// The thresholds on numbers of points, adapted to the density of points.
struct PointThresholds
{
  double gap_points_to_block = 0.0;  ///< over the clearance length
  double min_points_inside = 0.0;    ///< over the clearance length
};

/// ShellConfig's thresholds for points `spacing` metres apart. With `scale_with_density` they are scaled by
/// (reference_spacing / spacing)^2, in proportion to the number of points on a surface, and are at least 2. Without it,
/// or with a spacing of 0 (unknown), they are those of the configuration.
PointThresholds pointThresholds(const ShellConfig& config, double spacing);

struct ShellSearchResult
{
  enum Status
  {
    found,
    too_short,  ///< a clear gap, but over less than the minimum length
    none
  };
  Status status = none;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();     ///< unit
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< m, on the axis, in the middle of the length
  double inner_radius = 0.0;                           ///< m
  double length = 0.0;                                 ///< m
  std::uint32_t points_inside = 0;  ///< cloud points over the length, at most inner_radius from the axis
  std::uint32_t points_in_gap = 0;  ///< cloud points over the length, in the gap
};

/// FitShell (paper, section IV). It tries radii from the fitted one up to the capture radius, in steps. The result is
/// the smallest radius whose gap is clear of the cloud's points and which has enough points inside.
///
/// **Length.** Without `measure_length` the gap must be clear over the clearance length, centred on the sample, as in
/// the paper. With `measure_length` the extent along the axis that is clear around and occupied inside is measured for
/// each radius. It must have the minimum length.
///
/// A place along the axis is occupied where the surface reaches `min_fill` of the inner radius. The tip of a corner or
/// of a cone always has some clear shell around it, but it reaches so far over a short extent only. Noise of the depth
/// makes a shell larger than the surface. Therefore a surface that falls short of the inner radius by `depth_error` or
/// less counts as well. Where no sensor could see the surface, because something is in front of it or nothing was
/// measured, the extent continues to where the surface is seen again.
///
/// **Recentering.** With `recenter` a cylinder is fitted to the points inside the shell that was found, and the search
/// is repeated about it. The neighborhood alone may show too short an arc of the surface, or another object beside it,
/// so that the first axis is not well placed.
///
/// **Straightening.** With `straighten` and several views, where no shell is found, a line is fitted to the middles of
/// slices about the axis, and the search is repeated about this line. One view may find a shell about an axis that is
/// wrong by some degrees. Several views see the surface from more sides: they see what such a shell would touch, and
/// they also give a better axis.
///
/// An instance keeps its working memory and serves one thread at a time.
class ShellSearch
{
public:
  ShellSearch();
  ~ShellSearch();
  ShellSearch(ShellSearch&&) noexcept;
  ShellSearch& operator=(ShellSearch&&) noexcept;

  ShellSearchResult search(const ShellSurroundings& surroundings, const FittedCylinder& cylinder,
                           const HandGeometry& hand, const ShellConfig& config);

private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace grasp_affordances
