#include "benchmark/textbook.h"

#include "core/views/stratified_draw.h"

#include <lapacke.h>
#include <pcl/common/centroid.h>
#include <pcl/common/point_tests.h>
#include <pcl/features/normal_3d.h>
#include <pcl/pcl_config.h>
#include <pcl/search/kdtree.h>
#include <pcl/search/organized.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace grasp_affordances::textbook
{
namespace
{

using Matrix10d = Eigen::Matrix<double, 10, 10>;
using Vector10d = Eigen::Matrix<double, 10, 1>;
using PclNormals = pcl::PointCloud<pcl::Normal>;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

class Stopwatch
{
public:
  double lap()
  {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(start_, now)).count();
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

Eigen::Matrix3d quadraticPart(const QuadricFit& quadric)
{
  const auto& c = quadric.c;
  Eigen::Matrix3d A;
  A << c[0], c[3] / 2, c[5] / 2, c[3] / 2, c[1], c[4] / 2, c[5] / 2, c[4] / 2, c[2];
  return A;
}

/// (I - N N') grad N, with N the unit normal of the level set through x.
Eigen::Matrix3d shapeOperator(const Eigen::Matrix3d& hessian, const Eigen::Vector3d& gradient)
{
  const double norm = gradient.norm();
  const Eigen::Vector3d normal = gradient / norm;
  return (Eigen::Matrix3d::Identity() - normal * normal.transpose()) * hessian / norm;
}

/// The principal curvature of larger magnitude, and the tangent about which the surface has it.
Curvature largerCurvature(const Eigen::Matrix3d& hessian, const Eigen::Vector3d& gradient)
{
  const Eigen::EigenSolver<Eigen::Matrix3d> solver(shapeOperator(hessian, gradient));
  Eigen::Index larger = 0;
  const double magnitude = solver.eigenvalues().real().cwiseAbs().maxCoeff(&larger);
  const Eigen::Vector3d direction = solver.eigenvectors().col(larger).real();
  return {magnitude, gradient.cross(direction).normalized()};
}

}  // namespace

PclCloud::Ptr toPcl(const Cloud& cloud)
{
  PclCloud::Ptr result(new PclCloud(cloud.width, cloud.height));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    result->points[i].getVector3fMap() = cloud.point(i);
  }
  result->is_dense = false;
  return result;
}

std::optional<QuadricFit> fitQuadric(const LocalPoints& points)
{
  Matrix10d M = Matrix10d::Zero(), N = Matrix10d::Zero();
  Vector10d l, l_x, l_y, l_z;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double x = points(0, i), y = points(1, i), z = points(2, i);
    l << x * x, y * y, z * z, x * y, y * z, x * z, x, y, z, 1;
    l_x << 2 * x, 0, 0, y, 0, z, 1, 0, 0, 0;
    l_y << 0, 2 * y, 0, x, z, 0, 0, 1, 0, 0;
    l_z << 0, 0, 2 * z, 0, y, x, 0, 0, 1, 0;
    M.noalias() += l * l.transpose();
    N.noalias() += l_x * l_x.transpose();
    N.noalias() += l_y * l_y.transpose();
    N.noalias() += l_z * l_z.transpose();
  }

  Vector10d alpha_real, alpha_imaginary, beta;
  Matrix10d vectors;
  const lapack_int info = LAPACKE_dggev(LAPACK_COL_MAJOR, 'N', 'V', 10, M.data(), 10, N.data(), 10, alpha_real.data(),
                                        alpha_imaginary.data(), beta.data(), nullptr, 1, vectors.data(), 10);
  if (info != 0) {
    throw std::runtime_error("dggev: info = " + std::to_string(info));
  }
  QuadricFit best;
  best.residual = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < 10; ++i) {
    const double eigenvalue = std::abs(alpha_real[i] / beta[i]);  // infinite, or close to it, for the constant term
    if (eigenvalue < best.residual) {
      best = {vectors.col(i), eigenvalue};
    }
  }
  return std::isfinite(best.residual) ? std::optional<QuadricFit>(best) : std::nullopt;
}

std::optional<Curvature> medianCurvature(const QuadricFit& quadric, const LocalPoints& points, int count,
                                         std::mt19937& random)
{
  const Eigen::Matrix3d A = quadraticPart(quadric);
  const Eigen::Vector3d b = quadric.c.segment<3>(6);
  const Eigen::Matrix3d hessian = 2 * A;
  const bool all = points.cols() <= count;
  std::uniform_int_distribution<Eigen::Index> draw(0, points.cols() - 1);

  std::vector<Curvature> curvatures;
  curvatures.reserve(static_cast<std::size_t>(count));
  for (Eigen::Index i = 0; i < (all ? points.cols() : count); ++i) {
    Eigen::Vector3d x = points.col(all ? i : draw(random));
    Eigen::Vector3d gradient = hessian * x + b;
    x -= (x.dot(A * x + b) + quadric.c[9]) / gradient.squaredNorm() * gradient;
    gradient = hessian * x + b;
    if (x.squaredNorm() <= 1.0 && gradient.squaredNorm() > 0.0) {
      curvatures.push_back(largerCurvature(hessian, gradient));
    }
  }
  if (curvatures.empty()) {
    return std::nullopt;
  }
  const auto median = curvatures.begin() + static_cast<std::ptrdiff_t>(curvatures.size() / 2);
  std::nth_element(curvatures.begin(), median, curvatures.end(),
                   [](const Curvature& a, const Curvature& b) { return a.magnitude < b.magnitude; });
  return *median;
}

Circle fitCircle(const LocalPoints& points, const Eigen::Vector3d& axis)
{
  Eigen::Matrix<double, 2, 3> plane;
  plane.row(0) = axis.unitOrthogonal();
  plane.row(1) = axis.cross(plane.row(0));
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_side = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector2d p = plane * points.col(i);
    const Eigen::Vector3d l(p.x(), p.y(), 1.0);
    sum += l * l.transpose();
    right_side -= p.squaredNorm() * l;
  }
  const Eigen::Vector3d abc = sum.ldlt().solve(right_side);
  const Eigen::Vector2d center = -abc.head<2>() / 2;
  return {plane.transpose() * center, std::sqrt(center.squaredNorm() - abc.z())};
}

namespace
{

/// One cloud: what the samples share, and the working memory that they take turns with.
class Frame
{
public:
  Frame(const PclCloud::ConstPtr& cloud, const Config& config) : config_(config), cloud_(cloud)
  {
    if (cloud->isOrganized()) {
      const pcl::search::OrganizedNeighbor<pcl::PointXYZ>::Ptr organized(
          new pcl::search::OrganizedNeighbor<pcl::PointXYZ>);
      organized->setInputCloud(cloud);
      if (organized->isValid()) {
        organized_ = organized;
        search_ = organized;
      }
    }
    if (!search_) {
      search_.reset(new pcl::search::KdTree<pcl::PointXYZ>(false));
      search_->setInputCloud(cloud);
    }
    if (config.estimation.estimator == Estimator::normals) {
      computeNormals(config.estimation.normals_radius);
    }
  }

  /// The body of Algorithm 1's loop: where the sample ends.
  Outcome examine(std::uint32_t index, std::mt19937& random, Shell& shell);

  StageTimes times;  // summed over the samples

private:
  void computeNormals(double radius);
  void findNeighborhood();
  bool isOccluded() const;
  std::optional<Curvature> estimateAxis(std::mt19937& random);
  Outcome fitShell(const Eigen::Vector3d& axis, Shell& shell);

  const Config& config_;
  PclCloud::ConstPtr cloud_;
  pcl::search::Search<pcl::PointXYZ>::Ptr search_;
  pcl::search::OrganizedNeighbor<pcl::PointXYZ>::Ptr organized_;  // null where the cloud has no image to project to
  PclNormals normals_;
  pcl::PointXYZ sample_;
  double radius_ = 0.0;  // m, of the neighborhood
  std::vector<int> indices_, around_axis_;
  std::vector<float> squared_distances_;
  LocalPoints points_;
};

Outcome Frame::examine(std::uint32_t index, std::mt19937& random, Shell& shell)
{
  Stopwatch stopwatch;
  sample_ = cloud_->points[index];
  findNeighborhood();
  times.neighborhoods += stopwatch.lap();
  if (indices_.size() < static_cast<std::size_t>(config_.neighborhood.min_points)) {
    return Outcome::too_few_points;
  }

  const bool hidden = isOccluded();
  times.occlusion += stopwatch.lap();
  if (hidden) {
    return Outcome::occluded;
  }

  const auto curvature = estimateAxis(random);
  times.fit += stopwatch.lap();
  if (!curvature) {
    return Outcome::degenerate;
  }
  if (curvature->magnitude / radius_ < 1.0 / config_.hand.capture_radius) {
    return Outcome::low_curvature;
  }

  shell.curvature = curvature->magnitude / radius_;
  shell.point_index = index;
  const Outcome outcome = fitShell(curvature->axis, shell);
  times.shell += stopwatch.lap();
  return outcome;
}

void Frame::computeNormals(double radius)
{
#if PCL_VERSION_COMPARE(>=, 1, 12, 0)
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(cloud_);
  estimation.setSearchMethod(search_);
  estimation.setRadiusSearch(radius);
  estimation.compute(normals_);
#else  // which sums covariances in single precision, and loses most of their digits
  normals_.resize(cloud_->size());
  for (std::size_t i = 0; i < cloud_->size(); ++i) {
    Eigen::Map<Eigen::Vector3f> normal = normals_.points[i].getNormalVector3fMap();
    normal.setConstant(std::numeric_limits<float>::quiet_NaN());
    if (pcl::isFinite(cloud_->points[i]) &&
        search_->radiusSearch(cloud_->points[i], radius, indices_, squared_distances_) >= 3) {
      Eigen::Matrix3d covariance;
      Eigen::Vector4d centroid;
      pcl::computeMeanAndCovarianceMatrix(*cloud_, indices_, covariance, centroid);
      normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(0).cast<float>();
    }
  }
#endif
}

void Frame::findNeighborhood()
{
  if (config_.neighborhood.kind == NeighborhoodKind::knn) {
    search_->nearestKSearch(sample_, config_.neighborhood.k, indices_, squared_distances_);
    radius_ = std::sqrt(*std::max_element(squared_distances_.begin(), squared_distances_.end()));
  } else {
    radius_ = config_.neighborhood.radius > 0.0 ? config_.neighborhood.radius : config_.hand.capture_radius;
    search_->radiusSearch(sample_, radius_, indices_, squared_distances_);
  }
}

/// FilterOcclusion (section IV-A): the sphere projects to a circle in the range image.
bool Frame::isOccluded() const
{
  if (!config_.occlusion.filter || !organized_) {
    return false;
  }
  float closest = std::numeric_limits<float>::infinity();
  for (const int i : indices_) {
    closest = std::min(closest, cloud_->points[i].getVector3fMap().squaredNorm());
  }

  pcl::PointXYZ beside = sample_;
  beside.x += static_cast<float>(radius_);
  pcl::PointXY center, rim;
  organized_->projectPoint(sample_, center);
  organized_->projectPoint(beside, rim);
  const float circle = std::abs(rim.x - center.x);
  const int first_row = std::max(0, static_cast<int>(std::ceil(center.y - circle)));
  const int last_row = std::min(static_cast<int>(cloud_->height) - 1, static_cast<int>(std::floor(center.y + circle)));
  int in_front = 0;
  for (int v = first_row; v <= last_row; ++v) {
    const float dv = static_cast<float>(v) - center.y;
    const float half_width = std::sqrt(std::max(0.0F, circle * circle - dv * dv));
    const int first = std::max(0, static_cast<int>(std::ceil(center.x - half_width)));
    const int last = std::min(static_cast<int>(cloud_->width) - 1, static_cast<int>(std::floor(center.x + half_width)));
    for (int u = first; u <= last; ++u) {
      in_front += cloud_->at(u, v).getVector3fMap().squaredNorm() < closest ? 1 : 0;  // false for NaN
    }
  }
  return in_front > config_.occlusion.max_points_in_front;
}

/// The variations PCA and Normals know no curvature: NaN.
std::optional<Curvature> Frame::estimateAxis(std::mt19937& random)
{
  points_.resize(Eigen::NoChange, static_cast<Eigen::Index>(indices_.size()));
  for (std::size_t i = 0; i < indices_.size(); ++i) {
    points_.col(static_cast<Eigen::Index>(i)) =
        (cloud_->points[indices_[i]].getVector3fMap() - sample_.getVector3fMap()).cast<double>() / radius_;
  }
  if (config_.estimation.estimator == Estimator::taubin) {
    const auto quadric = fitQuadric(points_);
    return quadric ? medianCurvature(*quadric, points_, config_.estimation.curvature_points, random) : std::nullopt;
  }
  if (config_.estimation.estimator == Estimator::pca) {
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // PCL up to 1.11 loses most digits of it in single precision
    Eigen::Vector4d centroid;
    pcl::computeMeanAndCovarianceMatrix(*cloud_, indices_, covariance, centroid);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    return Curvature{kUnknown, solver.eigenvectors().col(2)};
  }
  Eigen::Matrix3f sum = Eigen::Matrix3f::Zero();
  for (const int i : indices_) {
    const Eigen::Vector3f normal = normals_.points[i].getNormalVector3fMap();
    if (normal.allFinite()) {
      sum += normal * normal.transpose();
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver(sum);
  return Curvature{kUnknown, solver.eigenvectors().col(0).cast<double>()};
}

/// FitShell (section IV-B).
Outcome Frame::fitShell(const Eigen::Vector3d& axis, Shell& shell)
{
  const HandGeometry& hand = config_.hand;
  const double half_length = config_.shell.clearance_length / 2;
  const Circle circle = fitCircle(points_, axis);
  const Eigen::Vector3d origin = sample_.getVector3fMap().cast<double>() + radius_ * circle.center;
  if (!(radius_ * circle.radius <= hand.capture_radius)) {
    return Outcome::no_shell;
  }
  const pcl::PointXYZ center(static_cast<float>(origin.x()), static_cast<float>(origin.y()),
                             static_cast<float>(origin.z()));
  search_->radiusSearch(center, std::hypot(hand.capture_radius + hand.finger_thickness, half_length), around_axis_,
                        squared_distances_);

  for (double radius = radius_ * circle.radius; radius <= hand.capture_radius; radius += config_.shell.radius_step) {
    std::uint32_t inside = 0, in_gap = 0;
    for (const int i : around_axis_) {
      const Eigen::Vector3d p = cloud_->points[i].getVector3fMap().cast<double>() - origin;
      const double along = p.dot(axis);
      if (std::abs(along) <= half_length) {
        const double radial = (p - along * axis).norm();
        inside += radial <= radius ? 1 : 0;
        in_gap += radial > radius && radial <= radius + hand.finger_thickness ? 1 : 0;
      }
    }
    if (static_cast<int>(in_gap) < config_.shell.gap_points_to_block &&
        static_cast<int>(inside) >= config_.shell.min_points_inside) {
      Eigen::Index largest = 0;
      axis.cwiseAbs().maxCoeff(&largest);
      shell.axis = axis[largest] < 0.0 ? Eigen::Vector3d(-axis) : axis;
      shell.centroid = origin;
      shell.normal = (origin.dot(axis) * axis - origin).normalized();
      shell.inner_radius = radius;
      shell.thickness = hand.finger_thickness;
      shell.length = config_.shell.clearance_length;
      shell.observed_free = kUnknown;
      shell.points_inside = inside;
      shell.points_in_gap = in_gap;
      return Outcome::shell;
    }
  }
  return Outcome::no_shell;
}

}  // namespace

Pipeline::Pipeline(Config config) : config_(std::move(config)) {}

Localization Pipeline::localize(const PclCloud::ConstPtr& cloud)
{
  Stopwatch stopwatch, total;
  Localization result;
  Frame frame(cloud, config_);
  std::vector<std::uint32_t> measured;
  measured.reserve(cloud->size());
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    if (pcl::isFinite(cloud->points[i])) {
      measured.push_back(static_cast<std::uint32_t>(i));
    }
  }
  result.points = static_cast<std::uint32_t>(measured.size());
  result.threads = 1;
  const double preparation = stopwatch.lap();

  std::mt19937 random(static_cast<std::mt19937::result_type>(config_.sampling.seed));
  result.sampled = measured.empty() ? 0U : static_cast<std::uint32_t>(config_.sampling.samples);
  for (std::uint32_t i = 0; i < result.sampled; ++i) {
    Shell shell;
    const Outcome outcome = frame.examine(drawStratified(measured, {}, config_.sampling, i), random, shell);
    ++result.counts[static_cast<std::size_t>(outcome)];
    if (outcome == Outcome::shell) {
      result.shells.push_back(shell);
    }
  }
  result.milliseconds = frame.times;
  result.milliseconds.preparation = preparation;
  result.milliseconds.total = total.lap();
  return result;
}

}  // namespace grasp_affordances::textbook
