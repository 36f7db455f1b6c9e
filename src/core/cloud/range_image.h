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

/// Least-squares intrinsics of an organized cloud: regression of the pixel coordinates on x/z and y/z.
/// Empty where they are undetermined (no points, points of one column or row only) or where a point has z <= 0.
/// @param team shares the work, without influence on the result; none: the caller's thread does it.
std::optional<ReprojectionFit> estimateIntrinsics(const Cloud& cloud, ThreadTeam* team = nullptr);

/// The residual of given intrinsics. Empty where one of them is not finite, or a point has z <= 0.
std::optional<ReprojectionFit> checkIntrinsics(const Cloud& cloud, const PinholeIntrinsics& intrinsics,
                                               ThreadTeam* team = nullptr);

/// An organized cloud seen as what it was measured as: a range image, whose pixels its points reproject to. Refers to
/// the cloud, which must outlive it. Safe to read from many threads.
class RangeImage
{
public:
  /// Points further than this (pixels) from their pixel show that the cloud is not in its optical frame.
  static constexpr double kMaxResidual = 4.0;

  /// Longest side (pixels): working memory of each thread grows with it.
  static constexpr std::uint32_t kLongestSide = 16384;

  /// Empty where the cloud is not organized or too long, or its points do not reproject; `warning` then says why.
  /// Intrinsics that the cloud carries and that do not fit are replaced by estimated ones, with a warning. Allocates
  /// nothing but warnings.
  static std::optional<RangeImage> create(const Cloud& cloud, std::string& warning, ThreadTeam* team = nullptr);

  /// Another cloud of the same size, each point of which is on its pixel's ray, seen by the same camera.
  RangeImage withCloud(const Cloud& cloud) const
  {
    RangeImage image = *this;
    image.cloud_ = &cloud;
    return image;
  }

  const Cloud& cloud() const { return *cloud_; }
  const PinholeIntrinsics& intrinsics() const { return intrinsics_; }
  double margin() const { return margin_; }  ///< pixels, by which points may be off their own

  /// The pixels that a sphere projects to: contains every measured point within the sphere. Empty for a center (m, in
  /// the range of single precision) that is not finite.
  PixelWindow window(const Eigen::Vector3d& center, double radius) const;

  /// Index of the pixel that a point (m) falls on; empty outside the image and behind the sensor.
  std::optional<std::size_t> pixel(const Eigen::Vector3d& point) const;

  /// Distance (m) between the points of neighboring pixels on a surface facing the sensor, at depth z (m).
  double spacing(double z) const;

private:
  RangeImage(const Cloud& cloud, const ReprojectionFit& fit);

  const Cloud* cloud_;
  PinholeIntrinsics intrinsics_;
  double margin_;  // pixels, by which a window is grown so that it holds points off their pixel
};

}  // namespace grasp_affordances
