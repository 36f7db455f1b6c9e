#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/neighborhoods.h"
#include "grasp_affordances/range_image.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
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

/// What a shell is searched in.
struct ShellSurroundings
{
  const NeighborhoodSearch& cloud;
  const NeighborhoodSearch* hidden =
      nullptr;                        ///< what is taken to be where the sensor did not see: blocks gaps as well
  const RangeImage* image = nullptr;  ///< tells what was not seen, and how exactly depth was measured
  double spacing = 0.0;               ///< m, between neighboring points; 0: unknown
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
/// Keeps its working memory: one instance per thread.
class ShellSearch
{
public:
  ShellSearchResult search(const ShellSurroundings& surroundings, const FittedCylinder& cylinder,
                           const HandGeometry& hand, const ShellConfig& config);

private:
  struct AxisPoint
  {
    Eigen::Vector2d across;  // m, from the axis
    double along;            // m, on the axis from the cylinder's origin
    double radial;           // m, distance from the axis
  };
  struct Extent
  {
    double begin = 0.0, end = 0.0;  // m, along the axis
    std::uint32_t inside = 0, in_gap = 0, hidden_in_gap = 0;
    double length() const { return end - begin; }
  };
  struct Slices
  {
    std::size_t count = 1;
    double thickness = 0.0;  // m
    double begin = 0.0;      // m along the axis, of the first
  };
  struct Axis  // with the two directions across it
  {
    explicit Axis(const FittedCylinder& cylinder);
    Eigen::Vector3d origin, direction, first, second;
  };
  // Points per radius step and slice, up to some radius that grows with the steps.
  class Counts
  {
  public:
    void reset(std::size_t steps, std::size_t slices);
    void add(double radius, std::size_t slice, double first_radius, double radius_step);
    void accumulate();
    std::uint32_t operator()(std::size_t step, std::size_t slice) const { return counts_[step * slices_ + slice]; }

  private:
    std::size_t steps_ = 0, slices_ = 0;
    std::vector<std::uint32_t> counts_;
  };

  static Slices makeSlices(const ShellConfig& config, double spacing);
  ShellSearchResult searchAbout(const ShellSurroundings& surroundings, const FittedCylinder& cylinder,
                                const HandGeometry& hand, const ShellConfig& config);
  std::optional<FittedCylinder> refit(const FittedCylinder& cylinder, const ShellSearchResult& found,
                                      const HandGeometry& hand, double radius_step);
  void gatherPoints(const NeighborhoodSearch& cloud, const Axis& axis, double outer_radius,
                    std::vector<AxisPoint>& points);
  std::size_t sliceOf(const AxisPoint& point) const;
  void countPoints(double first_radius, double depth_error, const HandGeometry& hand, const ShellConfig& config);
  void findUnseenSlices(const RangeImage* image, const Axis& axis, double radius, const HandGeometry& hand);
  std::uint32_t gapPoints(std::size_t step, std::size_t slice) const;
  std::uint32_t hiddenGapPoints(std::size_t step, std::size_t slice) const;
  Extent extentOf(std::size_t step, std::size_t first_slice, std::size_t last_slice) const;
  Extent measuredExtent(std::size_t step, double points_to_block_slice) const;
  Extent refinedExtent(const Extent& extent, double inner_radius, double outer_radius, double margin,
                       double max_length) const;

  Slices slices_;
  Neighborhood sphere_;
  std::vector<AxisPoint> points_, hidden_points_;
  std::vector<Eigen::Vector2d> inside_;
  std::vector<bool> unseen_;  // slices
  std::size_t steps_ = 0;
  Counts fill_, inner_, outer_;         // of the points: up to the fill, to the inner and to the outer radius
  Counts hidden_inner_, hidden_outer_;  // of the hidden points
};

}  // namespace grasp_affordances
