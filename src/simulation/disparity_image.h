#pragma once

#include "grasp_affordances/cloud.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace grasp_affordances
{

struct Pixel
{
  int column;
  int row;
};

/// True disparities, f b / z in pixels, of the surfaces in an image; 0 where there is no surface.
class DisparityImage
{
public:
  /// @param depth m, row-major; infinite where there is no surface
  DisparityImage(const std::vector<float>& depth, int width, int height, const PinholeIntrinsics& camera,
                 double baseline);

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t index(Pixel p) const { return static_cast<std::size_t>(p.row) * width_ + p.column; }
  float operator()(Pixel p) const { return disparity_[index(p)]; }
  const float* row(int row) const { return &disparity_[index({0, row})]; }

  /// Whether a depth edge separates two pixels: their disparities differ by at least one pixel per pixel between them.
  /// On a surface that is edge-on to the projector they differ by just that.
  bool parted(Pixel a, Pixel b) const;

  /// Whether a depth edge separates a pixel from another one up to `reach` pixels away along its row or column.
  bool edgeWithin(int reach, Pixel p) const;

  /// The point on a pixel's ray with a depth of 1, in the optical frame.
  Eigen::Vector3d ray(Pixel p) const;

  /// Normal of the surface that a pixel shows. It points away from the camera and has any length. It is computed from
  /// the neighbouring pixels: on a plane, disparity is a linear function of column and row.
  Eigen::Vector3d normal(Pixel p) const;

private:
  bool contains(Pixel p) const { return p.column >= 0 && p.column < width_ && p.row >= 0 && p.row < height_; }
  double gradient(Pixel p, Pixel before, Pixel after) const;

  int width_;
  int height_;
  PinholeIntrinsics camera_;
  std::vector<float> disparity_;
};

}  // namespace grasp_affordances
