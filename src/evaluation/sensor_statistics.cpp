#include "evaluation/sensor_statistics.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace grasp_affordances
{
namespace
{

constexpr float kSmooth = 0.012F;     ///< of the depth: largest difference between neighbours on one surface
constexpr float kStep = 0.05F;        ///< m, smallest step of depth that is an edge
constexpr float kRampEnd = 0.1F;      ///< of the step, at either end: no ramp
constexpr std::size_t kShortest = 6;  ///< px, of a run that is taken for a surface
constexpr std::size_t kWidest = 60;   ///< px between the runs of an edge

/// One row or column of the depth image.
class Line
{
public:
  Line(const Cloud& cloud, std::size_t first, std::size_t stride, std::size_t length)
      : z_(cloud.z.data() + first), stride_(stride), length_(length)
  {
  }

  std::size_t length() const { return length_; }
  float operator[](std::size_t i) const { return z_[i * stride_]; }

private:
  const float* z_;
  std::size_t stride_, length_;
};

struct Stretch
{
  std::size_t first, last;
};

/// The surfaces along a line.
std::vector<Stretch> smoothStretches(const Line& line)
{
  std::vector<Stretch> runs;
  std::size_t first = 0;
  for (std::size_t i = 1; i <= line.length(); ++i) {
    if (i < line.length() && std::abs(line[i] - line[i - 1]) < kSmooth * line[i])
      continue;
    if (i - first >= kShortest)
      runs.push_back({first, i - 1});
    first = i;
  }
  return runs;
}

/// Adds up profiles; the means are made at the end.
class ProfileSum
{
public:
  void add(const Line& line, const Stretch& before, const Stretch& after)
  {
    const float from = line[before.last], step = line[after.first] - from;
    std::size_t holes = 0, ramp = 0;
    for (std::size_t i = before.last + 1; i < after.first; ++i) {
      const float share = (line[i] - from) / step;
      holes += std::isnan(line[i]) ? 1 : 0;
      ramp += share > kRampEnd && share < 1.0F - kRampEnd ? 1 : 0;
    }
    ++edges_;
    holes_ += holes;
    ramp_ += ramp;
    with_hole_ += holes > 0 ? 1 : 0;
    inverse_steps_ += std::abs(1.0 / line[after.first] - 1.0 / from);
  }

  /// @param focal_length px
  EdgeProfile mean(double focal_length) const
  {
    const auto n = static_cast<double>(std::max<std::size_t>(1, edges_));
    return {edges_, static_cast<double>(ramp_) / n, static_cast<double>(holes_) / n,
            static_cast<double>(with_hole_) / n,
            edges_ == 0 ? 0.0 : static_cast<double>(holes_) / (focal_length * inverse_steps_)};
  }

private:
  std::size_t edges_ = 0, holes_ = 0, ramp_ = 0, with_hole_ = 0;
  double inverse_steps_ = 0.0;
};

/// Calls use(line, run, next run, step) for every edge, and same(run, next run) for two runs of one surface.
template <typename Use, typename Same>
void forEachPair(const Line& line, Use&& use, Same&& same)
{
  const std::vector<Stretch> runs = smoothStretches(line);
  for (std::size_t r = 0; r + 1 < runs.size(); ++r) {
    const std::size_t between = runs[r + 1].first - runs[r].last;
    if (between > kWidest)
      continue;
    const float step = line[runs[r + 1].first] - line[runs[r].last];
    if (std::abs(step) >= kStep)
      use(line, runs[r], runs[r + 1], step);
    else if (std::abs(step) < kSmooth * line[runs[r].last] * static_cast<float>(between))
      same(runs[r], runs[r + 1]);
  }
}

/// In pixels, from the outermost points of the rows; 1 where there are none.
double focalLength(const Cloud& cloud)
{
  double columns = 0.0, slopes = 0.0;
  for (std::size_t row = 0; row < cloud.height; ++row) {
    const std::size_t begin = row * cloud.width, end = begin + cloud.width;
    std::size_t first = begin, last = end - 1;
    while (first < end && !cloud.measured(first))
      ++first;
    while (last > first && !cloud.measured(last))
      --last;
    if (first >= last)
      continue;
    columns += static_cast<double>(last - first);
    slopes += cloud.x[last] / cloud.z[last] - cloud.x[first] / cloud.z[first];
  }
  return slopes > 0.0 ? columns / slopes : 1.0;
}

/// Standard deviation in metres about the plane through a patch. On a plane 1/z is linear in column and row. Empty
/// unless all is measured and smooth.
std::optional<PlaneNoise> patchNoise(const Cloud& cloud, std::size_t column, std::size_t row, std::size_t size)
{
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  double squares = 0.0, depth = 0.0;
  for (std::size_t y = 0; y < size; ++y) {
    for (std::size_t x = 0; x < size; ++x) {
      const std::size_t i = (row + y) * cloud.width + column + x;
      if (!cloud.measured(i) || (x > 0 && std::abs(cloud.z[i] - cloud.z[i - 1]) > kSmooth * cloud.z[i]))
        return std::nullopt;
      const Eigen::Vector3d a(1.0, static_cast<double>(x) - 0.5 * (size - 1),
                              static_cast<double>(y) - 0.5 * (size - 1));
      const double inverse = 1.0 / cloud.z[i];
      M += a * a.transpose();
      v += inverse * a;
      squares += inverse * inverse;
      depth += cloud.z[i];
    }
  }
  const auto n = static_cast<double>(size * size);
  const double variance = std::max(0.0, squares - v.dot(M.ldlt().solve(v))) / n;
  depth /= n;
  return PlaneNoise{depth, depth * depth * std::sqrt(variance), 1};
}

std::vector<PlaneNoise> noiseByDepth(const Cloud& cloud)
{
  constexpr std::size_t size = 32;  // px
  constexpr double bin = 0.2;       // m
  std::map<int, std::vector<PlaneNoise>> bins;
  for (std::size_t row = 0; row + size <= cloud.height; row += size / 2) {
    for (std::size_t column = 0; column + size <= cloud.width; column += size / 2) {
      if (const std::optional<PlaneNoise> patch = patchNoise(cloud, column, row, size))
        bins[static_cast<int>(std::floor(patch->depth / bin))].push_back(*patch);
    }
  }
  std::vector<PlaneNoise> result;
  for (auto& [key, patches] : bins) {
    PlaneNoise mean;
    mean.patches = patches.size();
    for (const PlaneNoise& patch : patches)
      mean.depth += patch.depth / static_cast<double>(patches.size());
    const auto quartile = patches.begin() + static_cast<std::ptrdiff_t>(patches.size() / 4);
    std::nth_element(patches.begin(), quartile, patches.end(),
                     [](const PlaneNoise& a, const PlaneNoise& b) { return a.deviation < b.deviation; });
    mean.deviation = quartile->deviation;
    result.push_back(mean);
  }
  return result;
}

}  // namespace

SensorStatistics sensorStatistics(const Cloud& cloud)
{
  SensorStatistics result;
  std::size_t missing = 0, inside = 0, surface = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    missing += cloud.measured(i) ? 0 : 1;
  result.holes = static_cast<double>(missing) / static_cast<double>(std::max<std::size_t>(1, cloud.size()));

  ProfileSum left, right, vertical;
  const auto count_surface = [&](const Stretch& before, const Stretch& after) {
    inside += after.first - before.last - 1;
    surface += before.last - before.first + 1;
  };
  for (std::size_t row = 0; row < cloud.height; ++row) {
    forEachPair(
        Line(cloud, row * cloud.width, 1, cloud.width),
        [&](const Line& line, const Stretch& before, const Stretch& after, float step) {
          (step < 0.0F ? left : right).add(line, before, after);
        },
        count_surface);
  }
  for (std::size_t column = 0; column < cloud.width; ++column) {
    forEachPair(
        Line(cloud, column, cloud.width, cloud.height),
        [&](const Line& line, const Stretch& before, const Stretch& after, float) {
          vertical.add(line, before, after);
        },
        [](const Stretch&, const Stretch&) {});
  }
  result.surface_holes = static_cast<double>(inside) / static_cast<double>(std::max<std::size_t>(1, inside + surface));
  const double focal_length = focalLength(cloud);
  result.left = left.mean(focal_length);
  result.right = right.mean(focal_length);
  result.vertical = vertical.mean(focal_length);
  result.noise = noiseByDepth(cloud);
  return result;
}

}  // namespace grasp_affordances
