#pragma once

#include "core/neighborhoods/surroundings.h"
#include "grasp_affordances/config.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>

namespace grasp_affordances
{

/// Where the shell search starts: the axis and radius of the cylinder fitted to a neighborhood.
struct FittedCylinder
{
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m, projection of the sample onto the axis
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< unit
  double radius = 0.0;                               ///< m
};

/// The thresholds on numbers of points, where they have been adapted to the density of points.
struct PointThresholds
{
  double gap_points_to_block = 0.0;  ///< over the clearance length
  double min_points_inside = 0.0;    ///< over the clearance length
};

/// ShellConfig's thresholds for points `spacing` metres apart: as they stand, or with `scale_with_density` in
/// proportion to the number of points that a surface shows, but at least 2. A spacing of 0 means unknown: as they
/// stand.
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
  std::uint32_t points_inside = 0;
  std::uint32_t points_in_gap = 0;
};

/// FitShell (paper, section IV): the smallest radius, from the fitted one in steps up to the capture radius, with a gap
/// that is clear of the cloud's points and enough points inside it.
///
/// Without `measure_length` the gap must be clear over the clearance length, centred on the sample, as in the paper.
/// With it the clear and occupied extent around the sample is measured for each radius, and must have the minimum
/// length. Occupied is where the surface reaches `min_fill` of the inner radius: the tip of a corner or of a cone,
/// around which some shell always is clear, does so over a short extent only. Noise swells a shell, too: the surface
/// need reach no farther than `depth_error` short of it. Where nothing of the surface could be seen, because of
/// something in front or for lack of a measurement, the extent goes on to where it is seen again.
///
/// With `recenter` the cylinder is fitted anew to the points inside the shell that was found, and the search repeated:
/// the neighborhood may show too short an arc of the surface, or something else beside it, to place the axis well.
///
/// With `straighten` and several views, where no shell is found: a line through the middles of slices about the axis is
/// a better one, since all sides of the surface are seen, and the search is repeated about it. One view may find a
/// shell about an axis that is off by some degrees; several also see what such a shell would touch.
///
/// Keeps its working memory: one instance per thread.
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
