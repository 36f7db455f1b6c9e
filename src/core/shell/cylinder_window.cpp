#include "core/shell/cylinder_window.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace grasp_affordances
{
namespace
{

struct Interval
{
  double low, high;
};

/// A strip of the image. It covers the columns [begin + per_row v, begin + per_row v + width] of row v.
struct Strip
{
  double begin, per_row, width;
};

/// All quotients of a number in one interval and a positive number in another.
Interval quotients(const Interval& numerator, const Interval& denominator)
{
  return {numerator.low / (numerator.low < 0.0 ? denominator.low : denominator.high),
          numerator.high / (numerator.high < 0.0 ? denominator.high : denominator.low)};
}

/// The rays (x/z, y/z, 1) whose scalar product with `normal` is at most `reach` in magnitude, and `margin` pixels on
/// either side of them.
Strip strip(const PinholeIntrinsics& camera, const Eigen::Vector3d& normal, double reach, double margin)
{
  const double per_column = normal.x() / camera.fx, per_row = normal.y() / camera.fy;
  constexpr double kAlongRows = 1e-9;
  if (std::abs(per_column) < kAlongRows) {
    constexpr double kAnywhere = 1e9;
    return {-kAnywhere, 0.0, 2 * kAnywhere};
  }
  const double middle = camera.cx + (per_row * camera.cy - normal.z()) / per_column;
  const double half_width = (reach + margin * std::abs(per_row)) / std::abs(per_column) + margin;
  return {middle - half_width, -per_row / per_column, 2 * half_width};
}

/// Depths of the piece. Where they are not positive, the piece has no bounded projection.
Interval depths(const CylinderPiece& piece)
{
  const double z = piece.middle().z(), half = piece.reach(Eigen::Vector3d::UnitZ());
  return {z - half, z + half};
}

/// The columns or rows [begin, end) between two slopes, and `margin` pixels on either side of them.
std::pair<int, int> pixelRange(const Interval& slopes, double focal_length, double principal_point, double margin,
                               std::uint32_t pixels)
{
  const double a = focal_length * slopes.low + principal_point, b = focal_length * slopes.high + principal_point;
  const double size = pixels;
  return {static_cast<int>(std::clamp(std::min(a, b) - margin, 0.0, size)),
          static_cast<int>(std::clamp(std::max(a, b) + margin + 1.0, 0.0, size))};
}

PixelWindow boundingWindow(const RangeImage& image, const CylinderPiece& piece)
{
  const Cloud& cloud = image.cloud();
  const PinholeIntrinsics& camera = image.intrinsics();
  const Interval depth = depths(piece);
  if (depth.high <= 0.0) {
    return {0, 0, 0, 0};
  }
  if (!(depth.low > 0.0)) {
    return {0, static_cast<int>(cloud.width), 0, static_cast<int>(cloud.height)};
  }
  const Eigen::Vector3d middle = piece.middle();
  const auto slopes = [&](const Eigen::Vector3d& direction) {
    const double reach = piece.reach(direction), at = middle.dot(direction);
    return quotients({at - reach, at + reach}, depth);
  };
  const auto [u_begin, u_end] =
      pixelRange(slopes(Eigen::Vector3d::UnitX()), camera.fx, camera.cx, image.margin(), cloud.width);
  const auto [v_begin, v_end] =
      pixelRange(slopes(Eigen::Vector3d::UnitY()), camera.fy, camera.cy, image.margin(), cloud.height);
  return {u_begin, u_end, v_begin, v_end};
}

}  // namespace

void cylinderSpans(const RangeImage& image, const CylinderPiece& piece, std::vector<PixelSpan>& spans)
{
  spans.clear();
  const PixelWindow window = boundingWindow(image, piece);
  const PinholeIntrinsics& camera = image.intrinsics();
  const double margin = image.margin(), nearest = std::max(0.0, depths(piece).low);

  // Planes through the sensor and the middle, along the axis and across it.
  const Eigen::Vector3d middle = piece.middle();
  const Eigen::Vector3d across = piece.axis.cross(middle);
  constexpr double kAlongView = 1e-6;  // where the sensor looks along the axis, any such plane will do
  const Eigen::Vector3d side =
      across.norm() > kAlongView * middle.norm() ? across.normalized() : middle.unitOrthogonal();
  const Eigen::Vector3d end = middle.cross(side).normalized();
  const Strip limits[] = {strip(camera, side, piece.reach(side) / nearest, margin),
                          strip(camera, end, piece.reach(end) / nearest, margin)};
  for (int v = window.v_begin; v < window.v_end; ++v) {
    double u_begin = window.u_begin, u_end = window.u_end;
    for (const Strip& limit : limits) {
      const double begin = limit.begin + limit.per_row * v;
      u_begin = std::max(u_begin, begin);
      u_end = std::min(u_end, begin + limit.width + 1.0);
    }
    if (u_begin < u_end) {
      const std::size_t row = static_cast<std::size_t>(v) * image.cloud().width;
      spans.push_back({row + static_cast<std::size_t>(u_begin), row + static_cast<std::size_t>(u_end)});
    }
  }
}

double roundingWithin(const CylinderPiece& piece)
{
  constexpr double kRounding = 1e-6;  // about 16 units in the last place of a float
  const double reach = std::hypot(piece.radius, std::max(std::abs(piece.begin), std::abs(piece.end)));
  return kRounding * (piece.origin.cwiseAbs().maxCoeff() + reach + reach * reach / piece.radius);
}

CylinderBounds looseBounds(const CylinderPiece& piece, double rounding)
{
  CylinderBounds bounds;
  Eigen::Map<Eigen::Vector3f>(bounds.origin) = piece.origin.cast<float>();
  Eigen::Map<Eigen::Vector3f>(bounds.axis) = piece.axis.cast<float>();
  bounds.begin = static_cast<float>(piece.begin - 2 * rounding);
  bounds.end = static_cast<float>(piece.end + 2 * rounding);
  bounds.squared_radius = static_cast<float>((piece.radius + rounding) * (piece.radius + rounding));
  const double z = piece.middle().z(), half = piece.reach(Eigen::Vector3d::UnitZ()) + rounding;
  bounds.nearest = static_cast<float>(z - half);
  bounds.farthest = static_cast<float>(z + half);
  return bounds;
}

}  // namespace grasp_affordances
