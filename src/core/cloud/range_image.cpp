#include "core/cloud/range_image.h"

#include "core/kernels/ray_sums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

namespace grasp_affordances
{
namespace
{

/// Focal length and principal point by regression of the pixels on the slopes. Empty where all slopes are the same.
std::optional<std::pair<double, double>> fitLine(double points, double slope, double slope2, double pixel,
                                                 double product)
{
  const double variance = slope2 * points - slope * slope;
  if (!(variance > 1e-12 * slope2 * points)) {
    return std::nullopt;
  }
  const double focal_length = (product * points - slope * pixel) / variance;
  return std::make_pair(focal_length, (pixel - focal_length * slope) / points);
}

// Sums are taken over blocks of rows, and then over the blocks. The blocks are the same for any number of threads.
constexpr std::size_t kBlocks = 64;

/// Calls task(rows, block) for every block of the cloud's rows.
template <typename Task>
void forEachBlock(const Cloud& cloud, ThreadTeam* team, Task&& task)
{
  const auto run = [&](std::size_t block, std::size_t) {
    const std::size_t height = cloud.height;
    task(CloudRows{cloud.x.data(), cloud.y.data(), cloud.z.data(), cloud.width, height * block / kBlocks,
                   height * (block + 1) / kBlocks},
         block);
  };
  if (team != nullptr) {
    team->forEach(kBlocks, run);
    return;
  }
  for (std::size_t block = 0; block < kBlocks; ++block) {
    run(block, 0);
  }
}

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

std::optional<ReprojectionFit> checkIntrinsics(const Cloud& cloud, const PinholeIntrinsics& intrinsics,
                                               ThreadTeam* team)
{
  const Eigen::Array4d values(intrinsics.fx, intrinsics.fy, intrinsics.cx, intrinsics.cy);
  if (!values.isFinite().all()) {
    return std::nullopt;
  }
  const double f[] = {intrinsics.fx, intrinsics.fy}, c[] = {intrinsics.cx, intrinsics.cy};
  std::array<double, kBlocks> residuals;
  std::array<bool, kBlocks> in_front;
  forEachBlock(cloud, team, [&](const CloudRows& rows, std::size_t block) {
    in_front[block] = maxResidual(rows, f, c, residuals[block]);
  });
  if (std::find(in_front.begin(), in_front.end(), false) != in_front.end()) {
    return std::nullopt;
  }
  return ReprojectionFit{intrinsics, *std::max_element(residuals.begin(), residuals.end())};
}

std::optional<ReprojectionFit> estimateIntrinsics(const Cloud& cloud, ThreadTeam* team)
{
  std::array<RaySums, kBlocks> sums;
  std::array<bool, kBlocks> in_front;
  forEachBlock(cloud, team,
               [&](const CloudRows& rows, std::size_t block) { in_front[block] = sumRays(rows, sums[block]); });
  RaySums sum{};
  for (const RaySums& part : sums) {
    sum += part;
  }
  const auto column_fit = fitLine(sum.points, sum.slope_x, sum.slope_x2, sum.u, sum.slope_x_u);
  const auto row_fit = fitLine(sum.points, sum.slope_y, sum.slope_y2, sum.v, sum.slope_y_v);
  if (std::find(in_front.begin(), in_front.end(), false) != in_front.end() || !column_fit || !row_fit ||
      column_fit->first == 0.0 || row_fit->first == 0.0) {
    return std::nullopt;
  }
  return checkIntrinsics(cloud, {column_fit->first, row_fit->first, column_fit->second, row_fit->second}, team);
}

std::optional<RangeImage> RangeImage::create(const Cloud& cloud, std::string& warning, ThreadTeam* team)
{
  if (!cloud.organized()) {
    warning = "the cloud is not organized";
    return std::nullopt;
  }
  if (std::max(cloud.width, cloud.height) > kLongestSide) {
    warning = "the organized cloud of " + std::to_string(cloud.width) + "x" + std::to_string(cloud.height) +
              " points is no image: a side is longer than " + std::to_string(kLongestSide);
    return std::nullopt;
  }
  std::string given_warning;
  if (cloud.intrinsics) {
    const auto given = checkIntrinsics(cloud, *cloud.intrinsics, team);
    if (given && given->max_residual <= kMaxResidual) {
      return RangeImage(cloud, *given);
    }
    given_warning =
        "the camera's intrinsics " +
        (given ? "miss the cloud's pixels by up to " + residualText(given->max_residual) : "do not fit the cloud") +
        "; they were estimated from the cloud";
  }
  const auto fit = estimateIntrinsics(cloud, team);
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

std::optional<RangeImage> RangeImage::create(const Cloud& cloud, const PinholeIntrinsics& intrinsics, ThreadTeam* team)
{
  const auto fit = checkIntrinsics(cloud, intrinsics, team);
  return fit && fit->max_residual <= kMaxResidual ? std::optional<RangeImage>(RangeImage(cloud, *fit)) : std::nullopt;
}

RangeImage::RangeImage(const Cloud& cloud, const ReprojectionFit& fit)
    : cloud_(&cloud), intrinsics_(fit.intrinsics), margin_(fit.max_residual + 1e-3)
{
}

PixelWindow RangeImage::window(const Eigen::Vector3d& center, double radius) const
{
  const int width = static_cast<int>(cloud_->width);
  const int height = static_cast<int>(cloud_->height);
  if (center.z() <= -radius || !center.allFinite()) {
    return {0, 0, 0, 0};
  }
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
