#include "grasp_affordances/range_image.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace grasp_affordances
{
namespace
{

/// Calls visit(u, v, x/z, y/z) for every measured point; false where a point lies behind the sensor.
template <typename Visitor>
bool visitRays(const Cloud& cloud, Visitor&& visit)
{
  std::size_t i = 0;
  for (std::uint32_t v = 0; v < cloud.height; ++v) {
    for (std::uint32_t u = 0; u < cloud.width; ++u, ++i) {
      const double z = cloud.z[i];
      if (std::isnan(z)) {
        continue;
      }
      if (!(z > 0.0)) {
        return false;
      }
      visit(u, v, cloud.x[i] / z, cloud.y[i] / z);
    }
  }
  return true;
}

/// Simple linear regression of pixel coordinates on ray slopes.
class LineFit
{
public:
  void add(double slope, double pixel)
  {
    ++n_;
    slope_ += slope;
    pixel_ += pixel;
    slope2_ += slope * slope;
    product_ += slope * pixel;
  }

  /// Focal length and principal point; empty for slopes that do not differ.
  std::optional<std::pair<double, double>> solve() const
  {
    const double variance = slope2_ * n_ - slope_ * slope_;
    if (!(variance > 1e-12 * slope2_ * n_)) {
      return std::nullopt;
    }
    const double focal_length = (product_ * n_ - slope_ * pixel_) / variance;
    return std::make_pair(focal_length, (pixel_ - focal_length * slope_) / n_);
  }

private:
  double n_ = 0.0, slope_ = 0.0, pixel_ = 0.0, slope2_ = 0.0, product_ = 0.0;
};

/// Slopes [min, max] of the rays through the origin that touch a circle in the plane (lateral, z); the origin must be
/// outside it and z above the radius.
std::pair<double, double> tangentSlopes(double lateral, double z, double radius)
{
  const double denominator = z * z - radius * radius;
  const double root = radius * std::sqrt(lateral * lateral + denominator);
  return {(lateral * z - root) / denominator, (lateral * z + root) / denominator};
}

std::pair<int, int> pixelRange(const std::pair<double, double>& slopes, double focal_length, double principal_point,
                               double margin, std::uint32_t pixels)
{
  const double a = focal_length * slopes.first + principal_point;
  const double b = focal_length * slopes.second + principal_point;
  const double size = pixels;
  const int begin = static_cast<int>(std::clamp(std::ceil(std::min(a, b) - margin), 0.0, size));
  const int end = static_cast<int>(std::clamp(std::floor(std::max(a, b) + margin) + 1.0, 0.0, size));
  return {begin, std::max(begin, end)};
}

std::string residualText(double residual)
{
  std::ostringstream text;
  text.precision(3);
  text << residual << " pixels";
  return text.str();
}

}  // namespace

std::optional<ReprojectionFit> checkIntrinsics(const Cloud& cloud, const PinholeIntrinsics& intrinsics)
{
  const Eigen::Array4d values(intrinsics.fx, intrinsics.fy, intrinsics.cx, intrinsics.cy);
  if (!values.isFinite().all()) {
    return std::nullopt;
  }
  ReprojectionFit fit{intrinsics, 0.0};
  const bool in_front = visitRays(cloud, [&](double u, double v, double slope_x, double slope_y) {
    const double du = std::abs(intrinsics.fx * slope_x + intrinsics.cx - u);
    const double dv = std::abs(intrinsics.fy * slope_y + intrinsics.cy - v);
    fit.max_residual = std::max(fit.max_residual, std::max(du, dv));
  });
  return in_front ? std::optional<ReprojectionFit>(fit) : std::nullopt;
}

std::optional<ReprojectionFit> estimateIntrinsics(const Cloud& cloud)
{
  LineFit columns, rows;
  const bool in_front = visitRays(cloud, [&](double u, double v, double slope_x, double slope_y) {
    columns.add(slope_x, u);
    rows.add(slope_y, v);
  });
  const auto column_fit = columns.solve();
  const auto row_fit = rows.solve();
  if (!in_front || !column_fit || !row_fit || column_fit->first == 0.0 || row_fit->first == 0.0) {
    return std::nullopt;
  }
  return checkIntrinsics(cloud, {column_fit->first, row_fit->first, column_fit->second, row_fit->second});
}

std::optional<RangeImage> RangeImage::create(const Cloud& cloud, std::string& warning)
{
  if (!cloud.organized()) {
    warning = "the cloud is not organized";
    return std::nullopt;
  }
  std::string given_warning;
  if (cloud.intrinsics) {
    const auto given = checkIntrinsics(cloud, *cloud.intrinsics);
    if (given && given->max_residual <= kMaxResidual) {
      return RangeImage(cloud, *given);
    }
    given_warning =
        "the camera's intrinsics " +
        (given ? "miss the cloud's pixels by up to " + residualText(given->max_residual) : "do not fit the cloud") +
        "; they were estimated from the cloud";
  }
  const auto fit = estimateIntrinsics(cloud);
  if (!fit) {
    warning = "the cloud's points determine no projection onto its pixels (too few, or some behind the sensor)";
    return std::nullopt;
  }
  if (!(fit->max_residual <= kMaxResidual)) {
    warning = "the organized cloud's points miss their pixels by up to " + residualText(fit->max_residual) +
              ": it is not in its optical frame";
    return std::nullopt;
  }
  warning = given_warning;
  return RangeImage(cloud, *fit);
}

RangeImage::RangeImage(const Cloud& cloud, const ReprojectionFit& fit)
    : cloud_(&cloud), intrinsics_(fit.intrinsics), margin_(fit.max_residual + 1e-3)
{
}

PixelWindow RangeImage::window(const Eigen::Vector3d& center, double radius) const
{
  const int width = static_cast<int>(cloud_->width);
  const int height = static_cast<int>(cloud_->height);
  if (!(center.z() > 1.001 * radius)) {
    return {0, width, 0, height};
  }
  const auto [u_begin, u_end] =
      pixelRange(tangentSlopes(center.x(), center.z(), radius), intrinsics_.fx, intrinsics_.cx, margin_, cloud_->width);
  const auto [v_begin, v_end] = pixelRange(tangentSlopes(center.y(), center.z(), radius), intrinsics_.fy,
                                           intrinsics_.cy, margin_, cloud_->height);
  return {u_begin, u_end, v_begin, v_end};
}

std::optional<std::size_t> RangeImage::pixel(const Eigen::Vector3d& point) const
{
  if (!(point.z() > 0.0)) {
    return std::nullopt;
  }
  const double u = std::floor(intrinsics_.fx * point.x() / point.z() + intrinsics_.cx + 0.5);
  const double v = std::floor(intrinsics_.fy * point.y() / point.z() + intrinsics_.cy + 0.5);
  if (!(u >= 0.0 && v >= 0.0 && u < cloud_->width && v < cloud_->height)) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(v) * cloud_->width + static_cast<std::size_t>(u);
}

double RangeImage::spacing(double z) const
{
  return z / std::sqrt(std::abs(intrinsics_.fx * intrinsics_.fy));
}

}  // namespace grasp_affordances
