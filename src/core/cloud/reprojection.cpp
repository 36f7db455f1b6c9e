#include "core/cloud/reprojection.h"

#include "core/cloud/range_image.h"
#include "core/kernels/ray_sums.h"
#include "core/parallel/random.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr std::size_t kFewest = 16;  // points that a model is fitted to; the largest has 11 unknowns
constexpr double kNear = 2.0;        // pixels, from the pixel that a model says
constexpr double kNearlyAll = 0.95;  // share of the points that a model explains
constexpr int kRounds = 3;           // of a fit; each leaves out the worst of the round before

/// Points and the pixels that they are to project to.
struct Matches
{
  static constexpr std::size_t kMost = 2 * PixelSample::kMost;

  void add(const Eigen::Vector3d& point, double u, double v)
  {
    points[size] = point;
    pixels[size] = {u, v};
    ++size;
  }

  std::size_t size = 0;
  std::array<Eigen::Vector3d, kMost> points;
  std::array<Eigen::Vector2d, kMost> pixels;
};

using Distances = std::array<double, Matches::kMost>;  // pixels; infinite where a point has no projection

double median(std::array<double, Matches::kMost>& values, std::size_t count)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

Matches matchesOf(const Cloud& cloud, const PixelSample& sample)
{
  Matches matches;
  for (std::size_t i = 0; i < sample.size; ++i) {
    matches.add(sample.points[i], sample.indices[i] % cloud.width,
                sample.indices[i] / cloud.width);  // NOLINT(bugprone-integer-division): a row
  }
  return matches;
}

/// As if the points had been stored column by column, in columns of that length.
Matches matchesByColumn(const PixelSample& sample, std::uint32_t length)
{
  Matches matches;
  for (std::size_t i = 0; i < sample.size; ++i) {
    matches.add(sample.points[i], sample.indices[i] / length,  // NOLINT(bugprone-integer-division): a column
                sample.indices[i] % length);
  }
  return matches;
}

/// Focal length and principal point along one axis, by medians over pairs of points.
std::optional<std::pair<double, double>> robustLine(const Matches& matches, int axis)
{
  std::array<double, Matches::kMost> slopes, pixels, values;
  std::size_t count = 0;
  for (std::size_t i = 0; i < matches.size; ++i) {
    const Eigen::Vector3d& point = matches.points[i];
    if (point.z() > 0.0) {
      slopes[count] = point[axis] / point.z();
      pixels[count] = matches.pixels[i][axis];
      ++count;
    }
  }
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < count / 2; ++i) {
    const std::size_t j = i + count / 2;
    if (std::abs(pixels[j] - pixels[i]) >= 1.0) {
      values[pairs++] = (slopes[j] - slopes[i]) / (pixels[j] - pixels[i]);
    }
  }
  if (pairs < kFewest) {
    return std::nullopt;
  }
  const double per_pixel = median(values, pairs);
  if (per_pixel == 0.0 || !std::isfinite(1.0 / per_pixel)) {
    return std::nullopt;
  }
  const double focal_length = 1.0 / per_pixel;
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = pixels[i] - focal_length * slopes[i];
  }
  const double principal_point = median(values, count);
  return std::isfinite(principal_point) ? std::make_optional(std::make_pair(focal_length, principal_point))
                                        : std::nullopt;
}

std::optional<PinholeIntrinsics> robustIntrinsics(const Matches& matches)
{
  const auto columns = robustLine(matches, 0), rows = robustLine(matches, 1);
  if (!columns || !rows) {
    return std::nullopt;
  }
  return PinholeIntrinsics{columns->first, rows->first, columns->second, rows->second};
}

/// Share of the matches [begin, end) that are near enough.
double shareWithin(const Distances& distances, std::size_t begin, std::size_t end)
{
  std::size_t near = 0;
  for (std::size_t i = begin; i < end; ++i) {
    near += distances[i] <= kNear ? 1 : 0;
  }
  return end > begin ? static_cast<double>(near) / static_cast<double>(end - begin) : 0.0;
}

/// Distances of the matches from where a model projects their points to.
template <typename Project>
void measure(const Matches& matches, Distances& distances, Project&& project)
{
  for (std::size_t i = 0; i < matches.size; ++i) {
    const double distance = (project(matches.points[i]) - matches.pixels[i]).norm();
    distances[i] = std::isfinite(distance) ? distance : std::numeric_limits<double>::infinity();
  }
}

/// Fits a model in some rounds. Each leaves out the matches that the model before missed by far more than most.
/// @param fit(used)  fits to the matches whose distance is at most `used`, and renews all distances
/// @param distances  from a model to begin with; in and out
template <typename Fit>
void fitInRounds(const Matches& matches, Distances& distances, Fit&& fit)
{
  for (int round = 0; round < kRounds; ++round) {
    constexpr double kFar = 4.0, kLeast = 0.5;  // medians; pixels
    Distances sorted = distances;
    fit(std::max(kLeast, kFar * median(sorted, matches.size)));
  }
}

/// Where a point in front of the sensor falls; elsewhere NaN.
Eigen::Vector2d project(const PinholeIntrinsics& camera, const Eigen::Vector3d& point)
{
  if (!(point.z() > 0.0)) {
    return Eigen::Vector2d::Constant(std::nan(""));
  }
  return {camera.fx * (point.x() / point.z()) + camera.cx, camera.fy * (point.y() / point.z()) + camera.cy};
}

/// The share of the matches that intrinsics explain.
double explainedByIntrinsics(const Matches& matches, Distances& distances)
{
  distances.fill(std::numeric_limits<double>::infinity());
  if (const auto camera = robustIntrinsics(matches)) {
    measure(matches, distances, [&](const Eigen::Vector3d& point) { return project(*camera, point); });
  }
  return shareWithin(distances, 0, matches.size);
}

/// Fits u = f s + a s r^2 + b s r^4 + c, where s is the slope x/z (or y/z) of a ray, and r^2 the sum of the squares of
/// both slopes.
/// @param distances  under intrinsics; out: under this model
void fitLens(const Matches& matches, Distances& distances)
{
  constexpr double kSteepest = 3.0;  // slope; a point nearly beside the sensor would count for more than all others
  const auto isUsable = [](const Eigen::Vector3d& point) {
    return point.z() > 0.0 && point.head<2>().norm() <= kSteepest * point.z();
  };
  const auto rowOf = [](const Eigen::Vector3d& point, int axis) {
    const double s = point[axis] / point.z(), r2 = point.head<2>().squaredNorm() / (point.z() * point.z());
    return Eigen::Vector4d(s, s * r2, s * r2 * r2, 1.0);
  };
  fitInRounds(matches, distances, [&](double used) {
    Eigen::Vector4d lens[2];
    for (int axis = 0; axis < 2; ++axis) {
      Eigen::Matrix4d products = Eigen::Matrix4d::Zero();
      Eigen::Vector4d sums = Eigen::Vector4d::Zero();
      for (std::size_t i = 0; i < matches.size; ++i) {
        if (distances[i] <= used && isUsable(matches.points[i])) {
          const Eigen::Vector4d row = rowOf(matches.points[i], axis);
          products += row * row.transpose();
          sums += row * matches.pixels[i][axis];
        }
      }
      lens[axis] = products.ldlt().solve(sums);
    }
    measure(matches, distances, [&](const Eigen::Vector3d& point) {
      return isUsable(point) ? Eigen::Vector2d(lens[0].dot(rowOf(point, 0)), lens[1].dot(rowOf(point, 1)))
                             : Eigen::Vector2d::Constant(std::nan(""));
    });
  });
}

/// Fits a camera of any pose and any intrinsics: a projective matrix, by the direct linear transformation (Hartley,
/// Zisserman, "Multiple View Geometry in Computer Vision", section 7.1).
/// @param distances  out: under this model
void fitCamera(const Matches& matches, Distances& distances)
{
  // Points and pixels are centred and scaled, by medians: a few points may be anywhere.
  Eigen::Vector3d center;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  std::array<double, Matches::kMost> values;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < matches.size; ++i) {
      values[i] = matches.points[i][axis];
    }
    center[axis] = median(values, matches.size);
  }
  for (std::size_t i = 0; i < matches.size; ++i) {
    values[i] = (matches.points[i] - center).norm();
    middle += matches.pixels[i] / static_cast<double>(matches.size);
  }
  const double size = median(values, matches.size);
  for (std::size_t i = 0; i < matches.size; ++i) {
    values[i] = (matches.pixels[i] - middle).norm();
  }
  const double pixels = median(values, matches.size);
  if (!(size > 0.0 && std::isfinite(size) && pixels > 0.0)) {
    distances.fill(std::numeric_limits<double>::infinity());
    return;
  }
  using Rows = Eigen::Matrix<double, 12, 2>;
  using Products = Eigen::Matrix<double, 12, 12>;
  using Projection = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
  const auto scaled = [&](const Eigen::Vector3d& point) {
    return Eigen::Vector4d(((point - center) / size).homogeneous());
  };
  distances.fill(0.0);
  fitInRounds(matches, distances, [&](double used) {
    constexpr double kFarPoint = 100.0;  // sizes; such a point would count for more than all others
    Products products = Products::Zero();
    for (std::size_t i = 0; i < matches.size; ++i) {
      const Eigen::Vector4d point = scaled(matches.points[i]);
      if (distances[i] > used || !(point.norm() < kFarPoint)) {
        continue;
      }
      const Eigen::Vector2d pixel = (matches.pixels[i] - middle) / pixels;
      Rows rows = Rows::Zero();
      rows.block<4, 1>(0, 0) = point;
      rows.block<4, 1>(8, 0) = -pixel.x() * point;
      rows.block<4, 1>(4, 1) = point;
      rows.block<4, 1>(8, 1) = -pixel.y() * point;
      products.noalias() += rows * rows.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Products> eigen(products);
    const Eigen::Matrix<double, 12, 1> smallest = eigen.eigenvectors().col(0);
    const Eigen::Map<const Projection> projection(smallest.data());
    measure(matches, distances, [&](const Eigen::Vector3d& point) {
      const Eigen::Vector3d projected = projection * scaled(point);
      return Eigen::Vector2d(pixels * projected.head<2>() / projected.z() + middle);
    });
  });
}

}  // namespace

PixelSample::PixelSample(const Cloud& cloud)
{
  constexpr std::uint64_t kSeed = 977, kDraws = 4 * kMost;
  const auto add = [&](std::size_t index) {
    if (size < kMost && cloud.measured(index)) {
      points[size] = cloud.point(index).cast<double>();
      indices[size] = static_cast<std::uint32_t>(index);
      ++size;
    }
  };
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    add(randomIndex(randomBits(kSeed, i), static_cast<std::uint32_t>(cloud.size())));
  }
  if (size < kMost / 4) {  // a small cloud, or one with few measured points
    size = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      add(i);
    }
  }
}

std::optional<PinholeIntrinsics> robustIntrinsics(const Cloud& cloud, const PixelSample& sample)
{
  return robustIntrinsics(matchesOf(cloud, sample));
}

void listStrays(const Cloud& cloud, const PinholeIntrinsics& intrinsics, std::size_t most,
                std::vector<std::uint32_t>& strays)
{
  strays.clear();
  const double f[] = {intrinsics.fx, intrinsics.fy}, c[] = {intrinsics.cx, intrinsics.cy};
  for (std::size_t v = 0; v < cloud.height && strays.size() <= most; ++v) {
    double residual = 0.0;
    const CloudRows row{cloud.x.data(), cloud.y.data(), cloud.z.data(), cloud.width, v, v + 1};
    if (maxResidual(row, f, c, residual) && residual <= RangeImage::kMaxResidual) {
      continue;
    }
    for (std::size_t u = 0; u < cloud.width; ++u) {
      const std::size_t i = v * cloud.width + u;
      if (!cloud.measured(i)) {
        continue;
      }
      const double z = cloud.z[i], inverse = 1.0 / z;
      const double du = std::abs(f[0] * (cloud.x[i] * inverse) + (c[0] - static_cast<double>(u)));
      const double dv = std::abs(f[1] * (cloud.y[i] * inverse) + (c[1] - static_cast<double>(v)));
      if (!(z > 0.0 && du <= RangeImage::kMaxResidual && dv <= RangeImage::kMaxResidual)) {
        strays.push_back(static_cast<std::uint32_t>(i));
      }
    }
  }
}

Misfit explainMisfit(const Cloud& cloud, const PixelSample& sample)
{
  if (sample.size < kFewest) {
    return Misfit::too_few;
  }
  const Matches matches = matchesOf(cloud, sample);
  Distances distances;
  const double plain = explainedByIntrinsics(matches, distances);
  constexpr double kClearly = 0.01;  // share of the points
  const double enough = std::max(kNearlyAll, plain + kClearly);
  fitLens(matches, distances);
  if (shareWithin(distances, 0, matches.size) >= enough) {
    return Misfit::distorted;
  }
  for (const std::uint32_t length : {cloud.height, cloud.width}) {
    if (explainedByIntrinsics(matchesByColumn(sample, length), distances) >= enough) {
      return Misfit::columns_first;
    }
  }
  fitCamera(matches, distances);
  if (shareWithin(distances, 0, matches.size) >= enough) {
    return Misfit::moved;
  }
  return plain >= 0.5 ? Misfit::bad_points : Misfit::unexplained;
}

Misfit explainStrays(const Cloud& cloud, const PixelSample& sample, const std::vector<std::uint32_t>& strays)
{
  if (strays.size() < kFewest || sample.size < kFewest) {
    return Misfit::bad_points;
  }
  Matches matches = matchesOf(cloud, sample);
  const auto camera = robustIntrinsics(matches);
  const std::size_t others = matches.size, drawn = std::min(strays.size(), others);
  for (std::size_t i = 0; i < drawn; ++i) {
    const std::uint32_t stray = strays[i * strays.size() / drawn];
    matches.add(cloud.point(stray).cast<double>(), stray % cloud.width,
                stray / cloud.width);  // NOLINT(bugprone-integer-division): a row
  }
  Distances distances;
  const auto explained = [&] {
    constexpr double kOthers = 0.99, kStrays = 0.5;  // shares
    return shareWithin(distances, 0, others) >= kOthers && shareWithin(distances, others, matches.size) >= kStrays;
  };
  if (camera) {
    measure(matches, distances, [&](const Eigen::Vector3d& point) { return project(*camera, point); });
    fitLens(matches, distances);
    if (explained()) {
      return Misfit::distorted;
    }
  }
  fitCamera(matches, distances);
  return explained() ? Misfit::moved : Misfit::bad_points;
}

}  // namespace grasp_affordances
