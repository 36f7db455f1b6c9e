#pragma once

#include "grasp_affordances/cloud.h"

#include "core/parallel/thread_team.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <string>

namespace grasp_affordances
{

/// Half-open rectangle of pixels: columns [u_begin, u_end), rows [v_begin, v_end).
struct PixelWindow
{
  int u_begin, u_end;
  int v_begin, v_end;
};

/// How far a cloud's points fall from their own pixels under some intrinsics.
struct ReprojectionFit
{
  PinholeIntrinsics intrinsics;
  double max_residual = 0.0;  ///< pixels, the larger of the column's and the row's
};

/// Least-squares intrinsics of an organized cloud: regression of the pixel coordinates on x/z and y/z. Empty where the
/// points do not determine them (no points, or points of one column or row only), or where a point has z <= 0.
/// @param team  does the work, without influence on the result; null: the caller's thread does it
std::optional<ReprojectionFit> estimateIntrinsics(const Cloud& cloud, ThreadTeam* team = nullptr);

/// The residual of given intrinsics. Empty where one of the intrinsics is not finite, or a point has z <= 0.
std::optional<ReprojectionFit> checkIntrinsics(const Cloud& cloud, const PinholeIntrinsics& intrinsics,
                                               ThreadTeam* team = nullptr);

/// An organized cloud as a range image: each point projects to its own pixel. Refers to the cloud, which must outlive
/// it. Safe to read from many threads.
class RangeImage
{
public:
  /// Largest distance (pixels) of a point from its own pixel. A larger one shows that the cloud is not in its optical
  /// frame.
  static constexpr double kMaxResidual = 4.0;

  /// Longest side (pixels); the working memory of each thread grows with it.
  static constexpr std::uint32_t kLongestSide = 16384;

  /// Empty where the cloud is not organized, where a side is too long, or where points are too far from their pixels;
  /// `warning` then says why. Where the cloud's own intrinsics do not fit, they are estimated, with a warning.
  /// Allocates nothing but warnings.
  static std::optional<RangeImage> create(const Cloud& cloud, std::string& warning, ThreadTeam* team = nullptr);

  /// The range image of an organized cloud by a camera with these intrinsics. Empty where points are too far from their
  /// pixels.
  static std::optional<RangeImage> create(const Cloud& cloud, const PinholeIntrinsics& intrinsics,
                                          ThreadTeam* team = nullptr);

  /// The range image of another cloud of the same size by the same camera. Each of its points must be on its pixel's
  /// ray.
  RangeImage withCloud(const Cloud& cloud) const
  {
    RangeImage image = *this;
    image.cloud_ = &cloud;
    return image;
  }

  const Cloud& cloud() const { return *cloud_; }
  const PinholeIntrinsics& intrinsics() const { return intrinsics_; }
  double margin() const { return margin_; }  ///< pixels, by which points may be off their own pixel

  /// The pixels that a sphere projects to; they contain every measured point within the sphere. Empty for a center (m,
  /// in the range of single precision) that is not finite.
  PixelWindow window(const Eigen::Vector3d& center, double radius) const;

  /// Index of the pixel that a point (m) falls on; empty outside the image and behind the sensor.
  std::optional<std::size_t> pixel(const Eigen::Vector3d& point) const;

  /// Distance (m) between the points of neighboring pixels on a surface facing the sensor, at depth z (m).
  double spacing(double z) const;

private:
  RangeImage(const Cloud& cloud, const ReprojectionFit& fit);

  const Cloud* cloud_;
  PinholeIntrinsics intrinsics_;
  double margin_;  // pixels; windows are larger by as much, so that they hold points that are off their pixel
};

}  // namespace grasp_affordances
