#pragma once

#include "grasp_affordances/cloud.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace grasp_affordances
{

/// Some measured points of an organized cloud, drawn at random, and their pixels: the same for the same cloud.
struct PixelSample
{
  static constexpr std::size_t kMost = 1024;

  explicit PixelSample(const Cloud& cloud);

  std::size_t size = 0;
  std::array<Eigen::Vector3d, kMost> points;  ///< m
  std::array<std::uint32_t, kMost> indices;
};

/// Intrinsics of an organized cloud by medians. A quarter of the points may be anywhere. Empty where the others do not
/// determine them.
std::optional<PinholeIntrinsics> robustIntrinsics(const Cloud& cloud, const PixelSample& sample);

/// Lists the points that are farther than RangeImage::kMaxResidual from their own pixel, or behind the sensor.
/// @param most  with more than so many the list ends
void listStrays(const Cloud& cloud, const PinholeIntrinsics& intrinsics, std::size_t most,
                std::vector<std::uint32_t>& strays);

/// Why the points of an organized cloud do not fall on their pixels.
enum class Misfit
{
  moved,          ///< another pose of the camera explains where they are: they were moved out of the optical frame
  distorted,      ///< the distortion of a lens explains it
  columns_first,  ///< the columns were stored one after the other, not the rows
  bad_points,     ///< most fall on their pixels, and nothing explains the others
  too_few,        ///< there are too few points to tell
  unexplained
};

/// What explains nearly all points, and clearly more of them than intrinsics do.
Misfit explainMisfit(const Cloud& cloud, const PixelSample& sample);

/// Why a few points do not fall on their pixels: what explains half of them, with nearly all other points; bad points
/// where nothing does. Where a cloud was moved by a little, or its lens distorts by a little, most points stay near
/// their pixels.
Misfit explainStrays(const Cloud& cloud, const PixelSample& sample, const std::vector<std::uint32_t>& strays);

}  // namespace grasp_affordances
