#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/neighborhoods.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

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
/// proportion to the number of points that a surface shows. A spacing of 0 means unknown: as they stand.
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
/// around which some shell always is clear, does so over a short extent only.
///
/// Keeps its working memory: one instance per thread.
class ShellSearch
{
public:
  /// `spacing`: distance between neighboring points (m), 0 where it is not known.
  ShellSearchResult search(const NeighborhoodSearch& cloud, const FittedCylinder& cylinder, const HandGeometry& hand,
                           const ShellConfig& config, double spacing);

private:
  struct AxisPoint
  {
    double along;   // m, on the axis from the cylinder's origin
    double radial;  // m, distance from the axis
  };
  struct Extent
  {
    double begin = 0.0, end = 0.0;  // m, along the axis
    std::uint32_t inside = 0, in_gap = 0;
    double length() const { return end - begin; }
  };
  struct Slices
  {
    std::size_t count = 1;
    double thickness = 0.0;  // m
    double begin = 0.0;      // m along the axis, of the first
  };

  static Slices makeSlices(const ShellConfig& config, double spacing);
  void gatherPoints(const NeighborhoodSearch& cloud, const FittedCylinder& cylinder, double outer_radius);
  void countPoints(const FittedCylinder& cylinder, const HandGeometry& hand, const ShellConfig& config);
  Extent wholeExtent(std::size_t step) const;
  Extent measuredExtent(std::size_t step, double points_to_block_slice) const;
  Extent refinedExtent(const Extent& extent, double inner_radius, double outer_radius, double margin,
                       double max_length) const;

  Slices slices_;
  Neighborhood surroundings_;
  std::vector<AxisPoint> points_;
  std::size_t steps_ = 0;
  // Points per radius step and slice: up to the fill, to the inner and to the outer radius of the shell.
  std::vector<std::uint32_t> fill_counts_, inner_counts_, outer_counts_;
};

}  // namespace grasp_affordances
