#pragma once

#include "core/cloud/range_image.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// A point of a surface, with the normal there.
struct SurfaceElement
{
  Eigen::Vector3d point;   ///< m
  Eigen::Vector3d normal;  ///< unit, towards the sensor that measured it
};

/// Surface elements of a range image, in its optical frame. The image is divided into some 8000 cells. A cell has an
/// element where its middle shows a surface that is no farther than 3 m and smooth over a centimetre or two. Keeps its
/// memory from image to image.
class SurfaceElements
{
public:
  void compute(const RangeImage& image);

  /// The closest of the elements in the cell that the given element's point projects to and in the eight cells around
  /// it, among those whose normal is within 45 degrees of the given one. Null where there is none.
  const SurfaceElement* closest(const SurfaceElement& element) const;

  /// Some 1000 of the elements, or all where there are fewer, whose normals are spread as evenly as possible over all
  /// directions (normal-space sampling, Rusinkiewicz and Levoy 2001). Otherwise nearly all would lie on the table.
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
