#include "grasp_affordances/hidden_surfaces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace grasp_affordances
{
namespace
{

/// Inverse depth = at + slope * pixel.
struct Line
{
  double at, slope;

  double operator()(int pixel) const { return at + slope * pixel; }
};

/// A row or column of the image: inverse depth per pixel, NaN where nothing was measured, and how surfaces go on in it.
class ScanLine
{
public:
  /// Two stretches that belong to one surface: up to `left` and from `right` on.
  struct Bridge
  {
    int left, right;
    Line line;
  };

  void clear()
  {
    inverse_depth_.clear();
    sums_.assign(1, Sums());
  }

  void append(double depth)
  {
    const double d = 1.0 / depth;
    const auto i = static_cast<double>(inverse_depth_.size());
    inverse_depth_.push_back(d);
    sums_.push_back(std::isnan(d) ? sums_.back() : sums_.back() + Sums{1.0, i, i * i, d, i * d});
  }

  bool measuredBehind(int pixel, const Line& line) const { return inverse_depth_[pixel] < line(pixel) - kTolerance; }
  bool measuredAt(int pixel, const Line& line) const
  {
    return std::abs(inverse_depth_[pixel] - line(pixel)) <= kTolerance;
  }

  /// Calls visit(bridge) for all that are no wider than `max_width` (m) at `focal_length` (pixels).
  template <typename Visitor>
  void visitBridges(double max_width, double focal_length, Visitor&& visit);

private:
  static constexpr int kStretch = 12;          // pixels that show which way a surface goes
  static constexpr int kFewestMeasured = 9;    // of them
  static constexpr double kTolerance = 0.006;  // 1/m: two disparity steps of a structured-light sensor

  struct Sums
  {
    double n = 0.0, i = 0.0, ii = 0.0, d = 0.0, id = 0.0;

    Sums operator+(const Sums& other) const
    {
      return {n + other.n, i + other.i, ii + other.ii, d + other.d, id + other.id};
    }
    Sums operator-(const Sums& other) const
    {
      return {n - other.n, i - other.i, ii - other.ii, d - other.d, id - other.id};
    }
    Line line() const
    {
      const double slope = (id * n - i * d) / (ii * n - i * i);
      return {(d - slope * i) / n, slope};
    }
  };

  Sums stretch(int first) const { return sums_[first + kStretch] - sums_[first]; }
  bool leavesSurface(int pixel, int direction) const;
  std::optional<Line> commonLine(int left, int right) const;

  std::vector<double> inverse_depth_;
  std::vector<Sums> sums_;  // over the pixels before
  std::vector<int> left_, right_;
};

/// Whether a stretch that ends at a pixel goes no further in a direction (1, -1): what follows is nearer or missing.
bool ScanLine::leavesSurface(int pixel, int direction) const
{
  if (std::isnan(inverse_depth_[pixel])) {
    return false;
  }
  constexpr int kAhead = 3;
  const Sums sums = stretch(direction > 0 ? pixel - kStretch + 1 : pixel);
  if (sums.n < kFewestMeasured) {
    return false;
  }
  const Line line = sums.line();
  bool leaves = measuredAt(pixel, line);
  for (int k = 1; k <= kAhead && leaves; ++k) {
    const int ahead = pixel + direction * k;
    // The farther ahead, the less certain is the line. True for NaN.
    leaves = !(inverse_depth_[ahead] <= line(ahead) + kTolerance * (0.5 + 0.25 * k));
  }
  return leaves;
}

/// The line through the stretches on both sides, if they lie on one and nothing between them was measured behind it.
std::optional<Line> ScanLine::commonLine(int left, int right) const
{
  const Sums before = stretch(left - kStretch + 1), after = stretch(right);
  if (before.n < kFewestMeasured || after.n < kFewestMeasured) {
    return std::nullopt;
  }
  const Line line = (before + after).line();
  for (int k = 0; k < kStretch; ++k) {
    for (const int pixel : {left - k, right + k}) {
      if (!std::isnan(inverse_depth_[pixel]) && !measuredAt(pixel, line)) {
        return std::nullopt;
      }
    }
  }
  for (int pixel = left + 1; pixel < right; ++pixel) {
    if (measuredBehind(pixel, line)) {
      return std::nullopt;
    }
  }
  return line;
}

template <typename Visitor>
void ScanLine::visitBridges(double max_width, double focal_length, Visitor&& visit)
{
  left_.clear();
  right_.clear();
  const int size = static_cast<int>(inverse_depth_.size());
  for (int i = kStretch; i + kStretch < size; ++i) {
    if (leavesSurface(i, 1)) {
      left_.push_back(i);
    }
    if (leavesSurface(i, -1)) {
      right_.push_back(i);
    }
  }
  auto first = right_.begin();
  for (const int left : left_) {
    first = std::find_if(first, right_.end(), [&](int right) { return right > left + 1; });
    for (auto right = first; right != right_.end(); ++right) {
      const double depth = 1.0 / std::max(inverse_depth_[left], inverse_depth_[*right]);
      if ((*right - left) * depth > max_width * focal_length) {
        break;
      }
      if (const auto line = commonLine(left, *right)) {
        visit(Bridge{left, *right, *line});
        break;
      }
    }
  }
}

}  // namespace

Cloud continueSurfaces(const RangeImage& image, double max_width)
{
  const Cloud& cloud = image.cloud();
  const PinholeIntrinsics& camera = image.intrinsics();
  Cloud hidden;
  hidden.reset(cloud.width, cloud.height);

  ScanLine scan_line;
  const auto continueAlong = [&](std::size_t first, std::size_t stride, std::size_t size, double focal_length) {
    scan_line.clear();
    for (std::size_t i = 0; i < size; ++i) {
      scan_line.append(cloud.z[first + i * stride]);
    }
    scan_line.visitBridges(max_width, std::abs(focal_length), [&](const ScanLine::Bridge& bridge) {
      for (int i = bridge.left + 1; i < bridge.right; ++i) {
        const std::size_t pixel = first + static_cast<std::size_t>(i) * stride;
        const double z = 1.0 / bridge.line(i);
        if (scan_line.measuredAt(i, bridge.line) || hidden.z[pixel] >= z) {
          continue;
        }
        const double u = static_cast<double>(pixel % cloud.width), v = static_cast<double>(pixel / cloud.width);
        hidden.set(pixel, static_cast<float>((u - camera.cx) / camera.fx * z),
                   static_cast<float>((v - camera.cy) / camera.fy * z), static_cast<float>(z));
      }
    });
  };
  constexpr std::size_t kStride = 2;  // every other row and column leave one pixel of four without a point
  for (std::size_t v = 0; v < cloud.height; v += kStride) {
    continueAlong(v * cloud.width, 1, cloud.width, camera.fx);
  }
  for (std::size_t u = 0; u < cloud.width; u += kStride) {
    continueAlong(u, cloud.width, cloud.height, camera.fy);
  }
  return hidden;
}

}  // namespace grasp_affordances
