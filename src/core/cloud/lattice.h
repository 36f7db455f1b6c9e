#pragma once

#include "core/cloud/range_image.h"
#include "core/kernels/pixel_lookup.h"

#include <Eigen/Geometry>

#include <array>
#include <cstddef>

namespace grasp_affordances
{

/// A fixed number of points, and what the sensor measured at their pixels.
template <std::size_t Points>
class Lattice
{
public:
  void add(const Eigen::Vector3d& point)
  {
    x_[size_] = point.x();
    y_[size_] = point.y();
    z_[size_] = point.z();
    ++size_;
  }

  /// Brings the points from one frame to another.
  void transform(const Eigen::Isometry3d& T_to_from)
  {
    for (std::size_t i = 0; i < Points; ++i) {
      const Eigen::Vector3d point = T_to_from * Eigen::Vector3d(x_[i], y_[i], z_[i]);
      x_[i] = point.x();
      y_[i] = point.y();
      z_[i] = point.z();
    }
  }

  /// Calls visit(i, point, measured) for each point whose pixel measured something; i is the number of the point.
  template <typename Visitor>
  void visitMeasured(const RangeImage& image, Visitor&& visit)
  {
    const Cloud& cloud = image.cloud();
    const PinholeIntrinsics& camera = image.intrinsics();
    const double* const points[] = {x_.data(), y_.data(), z_.data()};
    lookUpPixels({camera.fx, camera.fy, camera.cx, camera.cy, static_cast<double>(cloud.width),
                  static_cast<double>(cloud.height)},
                 points, kRoom, pixels_.data());
    for (std::size_t i = 0; i < Points; ++i) {
      if (pixels_[i] < 0.0) {
        continue;
      }
      const auto pixel = static_cast<std::size_t>(pixels_[i]);
      if (cloud.measured(pixel)) {
        visit(i, Eigen::Vector3d(x_[i], y_[i], z_[i]), Eigen::Vector3d(cloud.point(pixel).cast<double>()));
      }
    }
  }

private:
  static constexpr std::size_t kRoom = (Points + kLookupGroup - 1) / kLookupGroup * kLookupGroup;

  std::array<double, kRoom> x_{}, y_{}, z_{}, pixels_{};  // zero beyond the points: seen by no pixel
  std::size_t size_ = 0;
};

}  // namespace grasp_affordances
