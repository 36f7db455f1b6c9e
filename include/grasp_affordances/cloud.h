#pragma once

#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace grasp_affordances
{

/// Pinhole projection without distortion: u = fx x / z + cx (column), v = fy y / z + cy (row); all in pixels.
/// The centre of the first pixel is (0, 0).
struct PinholeIntrinsics
{
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
};

/// The square of a length in single precision. All code uses this one expression, so that equal lengths compare equal.
inline float squaredLength(float x, float y, float z)
{
  return x * x + y * y + z * z;
}

/// A point cloud as three contiguous coordinate arrays, row-major where it is organized. Metres. The cloud does not
/// know the name of its frame. An organized cloud is expected in its optical frame (x right, y down, z forward).
///
/// A point is *measured* when the square of its distance from the origin is finite and above zero. NaN and infinite
/// coordinates, zeros, and coordinates whose square overflows are not measured: they are NaN in all three arrays.
struct Cloud
{
  std::uint32_t width = 0;   ///< columns
  std::uint32_t height = 0;  ///< rows; width or height is at most 1 where the cloud is not organized
  std::vector<float> x, y, z;

  /// m, the sensor's place in the cloud's frame; empty where it is not known. Not used for a range image: the sensor of
  /// that is at the origin. Where the place is not known, concave surfaces are not told from others, and normals are
  /// NaN.
  std::optional<Eigen::Vector3f> sensor_origin;

  /// Of the camera that measured an organized cloud. Where they are not given, they are estimated from the points.
  std::optional<PinholeIntrinsics> intrinsics;

  bool organized() const { return width > 1 && height > 1; }
  std::size_t size() const { return x.size(); }

  /// Makes room for columns x rows points, none of them measured.
  void reset(std::uint32_t columns, std::uint32_t rows)
  {
    width = columns;
    height = rows;
    const std::size_t points = std::size_t{columns} * rows;
    const float nan = std::nanf("");
    x.assign(points, nan);
    y.assign(points, nan);
    z.assign(points, nan);
  }

  /// Stores a point; one that does not count as measured is stored as NaN.
  void set(std::size_t index, float px, float py, float pz)
  {
    const float squared_range = squaredLength(px, py, pz);
    const bool measured = std::isfinite(squared_range) && squared_range > 0.0F;
    const float nan = std::nanf("");
    x[index] = measured ? px : nan;
    y[index] = measured ? py : nan;
    z[index] = measured ? pz : nan;
  }

  bool measured(std::size_t index) const { return !std::isnan(x[index]); }
  Eigen::Vector3f point(std::size_t index) const { return {x[index], y[index], z[index]}; }
};

/// One of several clouds of the same moment, and its place among them.
struct PosedCloud
{
  const Cloud* cloud = nullptr;  ///< in a frame of its own; an organized cloud in its optical frame
  Eigen::Isometry3d T_common_cloud = Eigen::Isometry3d::Identity();  ///< in the range of single precision
};

}  // namespace grasp_affordances
