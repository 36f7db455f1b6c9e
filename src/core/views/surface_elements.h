#pragma once

#include "core/cloud/range_image.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// A point of a surface, and which way the surface faces there.
struct SurfaceElement
{
  Eigen::Vector3d point;   ///< m
  Eigen::Vector3d normal;  ///< unit, towards the sensor that measured it
};

/// Surface elements of a range image on a grid of some 8000 cells, in its optical frame: one for each cell the middle
/// of which shows surface that is smooth over a centimetre or two, within 3 m. Keeps its memory from image to image.
class SurfaceElements
{
public:
  void compute(const RangeImage& image);

  /// Of the elements near the pixel that a point falls on, in its cell and the eight around that, the closest one that
  /// faces the same way within 45 degrees; null where there is none.
  const SurfaceElement* closest(const SurfaceElement& element) const;

  /// Some 1000 of the elements, or all where there are fewer, spread as evenly as they allow over the directions that
  /// they face (normal-space sampling, Rusinkiewicz and Levoy 2001): otherwise nearly all would lie on the table.
  const std::vector<SurfaceElement>& samples() const { return samples_; }

private:
  static constexpr std::size_t kDirections = 64;

  void drawSamples();

  PinholeIntrinsics intrinsics_;
  int cell_ = 1;  // px, side
  int columns_ = 0, rows_ = 0;
  std::vector<std::int32_t> cells_;  // index of the element; -1: none
  std::vector<SurfaceElement> elements_;
  std::array<std::vector<std::int32_t>, kDirections> facing_;  // indices of the elements
  std::vector<SurfaceElement> samples_;
};

}  // namespace grasp_affordances
