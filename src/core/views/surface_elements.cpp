#include "core/views/surface_elements.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace grasp_affordances
{
namespace
{

constexpr double kCells = 8000.0;
constexpr std::size_t kSamples = 1000;
constexpr float kMaxDepth = 3.0F;        // m; farther away, noise hides whether a surface is smooth
constexpr float kMaxDeparture = 0.015F;  // m from a straight line, at a depth of 1 m; grows with its square, as noise
constexpr float kMinCosine = 0.2F;       // of the angle between the normal and the direction to the sensor
constexpr double kSameWay = 0.7;         // cosine of the angle between normals that count as alike

/// Difference between two points, `reach` steps of the given stride before and after a middle one. Empty where the
/// three do not lie on one smooth surface.
std::optional<Eigen::Vector3f> tangent(const Cloud& cloud, std::size_t middle, std::size_t stride, int reach)
{
  const std::size_t before = middle - reach * stride, after = middle + reach * stride;
  const float z = cloud.z[middle];
  if (!(std::abs(0.5F * (cloud.z[before] + cloud.z[after]) - z) < kMaxDeparture * z * z)) {
    return std::nullopt;
  }
  return cloud.point(after) - cloud.point(before);
}

/// A tangent over the longer reach suffers less from noise; small parts have room for the shorter reach only.
std::optional<Eigen::Vector3f> tangent(const Cloud& cloud, std::size_t middle, std::size_t stride, int longer,
                                       int shorter)
{
  const auto result = tangent(cloud, middle, stride, longer);
  return result ? result : tangent(cloud, middle, stride, shorter);
}

std::optional<SurfaceElement> elementAt(const Cloud& cloud, std::size_t pixel, int longer, int shorter)
{
  if (!(cloud.z[pixel] < kMaxDepth)) {
    return std::nullopt;
  }
  const auto along_row = tangent(cloud, pixel, 1, longer, shorter);
  const auto along_column = tangent(cloud, pixel, cloud.width, longer, shorter);
  if (!along_row || !along_column) {
    return std::nullopt;
  }
  const Eigen::Vector3f point = cloud.point(pixel);
  const Eigen::Vector3f normal = along_column->cross(*along_row).normalized();  // x right, y down: towards the sensor
  if (!(-normal.dot(point) > kMinCosine * point.norm())) {
    return std::nullopt;
  }
  return SurfaceElement{point.cast<double>(), normal.cast<double>()};
}

/// The class of a normal's direction: a cell of a grid on the half of the octahedron that faces the sensor, since the
/// sensor sees only surfaces that face it.
std::size_t direction(const Eigen::Vector3d& normal, std::size_t directions)
{
  const auto side = static_cast<std::size_t>(std::lround(std::sqrt(directions)));
  const Eigen::Vector2d square = (normal.head<2>() / normal.lpNorm<1>()).array() * 0.5 + 0.5;
  const auto cell = [side](double x) { return std::min(side - 1, static_cast<std::size_t>(x * side)); };
  return cell(square.x()) * side + cell(square.y());
}

}  // namespace

void SurfaceElements::compute(const RangeImage& image)
{
  const Cloud& cloud = image.cloud();
  intrinsics_ = image.intrinsics();
  cell_ = std::max(1, static_cast<int>(std::lround(std::sqrt(cloud.size() / kCells))));
  columns_ = static_cast<int>(cloud.width) / cell_;
  rows_ = static_cast<int>(cloud.height) / cell_;
  cells_.assign(static_cast<std::size_t>(columns_) * rows_, -1);
  elements_.clear();
  for (std::vector<std::int32_t>& facing : facing_) {
    facing.clear();
  }
  const int longer = std::max(1, 3 * cell_ / 2), shorter = std::max(1, 5 * cell_ / 6);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const int u = column * cell_ + cell_ / 2, v = row * cell_ + cell_ / 2;
      if (u < longer || v < longer || u + longer >= static_cast<int>(cloud.width) ||
          v + longer >= static_cast<int>(cloud.height)) {
        continue;
      }
      if (const auto element = elementAt(cloud, static_cast<std::size_t>(v) * cloud.width + u, longer, shorter)) {
        const auto index = static_cast<std::int32_t>(elements_.size());
        cells_[static_cast<std::size_t>(row) * columns_ + column] = index;
        facing_[direction(element->normal, kDirections)].push_back(index);
        elements_.push_back(*element);
      }
    }
  }
  drawSamples();
}

/// Takes equally many elements of every class of directions, or all where a class has fewer.
void SurfaceElements::drawSamples()
{
  std::array<std::size_t, kDirections> sizes;
  std::transform(facing_.begin(), facing_.end(), sizes.begin(), [](const auto& facing) { return facing.size(); });
  std::sort(sizes.begin(), sizes.end());
  std::size_t left = kSamples, share = 0;
  for (std::size_t i = 0; i < kDirections; ++i) {
    share = left / (kDirections - i);
    left -= std::min(sizes[i], share);
  }
  samples_.clear();
  for (const std::vector<std::int32_t>& facing : facing_) {
    const std::size_t count = std::min(facing.size(), share);
    for (std::size_t i = 0; i < count; ++i) {
      samples_.push_back(elements_[facing[i * facing.size() / count]]);
    }
  }
}

const SurfaceElement* SurfaceElements::closest(const SurfaceElement& element) const
{
  const Eigen::Vector3d& point = element.point;
  const double u = (intrinsics_.fx * point.x() / point.z() + intrinsics_.cx + 0.5) / cell_;
  const double v = (intrinsics_.fy * point.y() / point.z() + intrinsics_.cy + 0.5) / cell_;
  if (!(point.z() > 0.0 && u >= 0.0 && v >= 0.0 && u < columns_ && v < rows_)) {
    return nullptr;
  }
  const int column = static_cast<int>(u), row = static_cast<int>(v);
  const SurfaceElement* closest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (int y = std::max(0, row - 1); y <= std::min(rows_ - 1, row + 1); ++y) {
    for (int x = std::max(0, column - 1); x <= std::min(columns_ - 1, column + 1); ++x) {
      const std::int32_t index = cells_[static_cast<std::size_t>(y) * columns_ + x];
      if (index < 0) {
        continue;
      }
      const SurfaceElement& candidate = elements_[static_cast<std::size_t>(index)];
      const double squared_distance = (candidate.point - point).squaredNorm();
      if (squared_distance < least && candidate.normal.dot(element.normal) > kSameWay) {
        least = squared_distance;
        closest = &candidate;
      }
    }
  }
  return closest;
}

}  // namespace grasp_affordances
