#include "core/views/view_comparison.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <cstddef>
#include <limits>

namespace grasp_affordances
{
namespace
{

constexpr double kCoarsestGate = 0.06;  // m, surfaces farther apart are not taken for the same
constexpr double kFinestGate = 0.01;    // m
constexpr double kRefinement = 0.88;    // ratio of the gates of one iteration and the one before
constexpr double kNearGate = 0.02;      // m, where a fit begins that stays near the given pose
constexpr std::size_t kMinPairs = 100;  // fewest pairs for a step
constexpr double kMinSupport = 0.2;     // fewest pairs of a fit, as a share of the samples of both views
constexpr double kClearlyMore = 1.1;    // ratio of numbers of pairs

/// Share of the strongest possible constraint. Nothing moves in a direction that is constrained less than that: noise
/// turns normals by 2.5 degrees, and such normals seem to constrain shifts along a plane as much.
constexpr double kMinConstraint = 0.002;

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

SurfaceElement transformed(const Eigen::Isometry3d& T, const SurfaceElement& element)
{
  return {T * element.point, T.linear() * element.normal};
}

/// A turn about a centre by a rotation vector (rad), and a translation (m).
Eigen::Isometry3d rigidMotion(const Vector6d& twist, const Eigen::Vector3d& center)
{
  const Eigen::Vector3d rotation = twist.head<3>();
  const double angle = rotation.norm();
  Eigen::Isometry3d motion(Eigen::Translation3d(center + twist.tail<3>()));
  if (angle > 0.0) {
    motion.rotate(Eigen::AngleAxisd(angle, rotation / angle));
  }
  return motion * Eigen::Translation3d(-center);
}

}  // namespace

double ViewAgreement::disagreement(const RangeImage& first, const RangeImage& second,
                                   const Eigen::Isometry3d& T_first_second)
{
  first_.compute(first);
  second_.compute(second);
  // A fit that begins with a wide gate may settle at a wrong pose. It counts only where it has clearly more support
  // than one that begins, and stays, near the given pose.
  const Fit far = fit(T_first_second, kCoarsestGate), near = fit(T_first_second, kNearGate);
  const Fit& better = far.support > kClearlyMore * near.support ? far : near;
  const double needed = kMinSupport * static_cast<double>(first_.samples().size() + second_.samples().size());
  const bool found = better.support > 0.0 && better.support >= needed;
  return found ? better.displacement : std::numeric_limits<double>::quiet_NaN();
}

ViewAgreement::Fit ViewAgreement::fit(const Eigen::Isometry3d& T_first_second, double gate)
{
  Eigen::Isometry3d correction = Eigen::Isometry3d::Identity();
  for (; gate > kFinestGate; gate *= kRefinement) {
    findPairs(correction * T_first_second, gate);
    if (pairs_.size() < kMinPairs) {
      return {};
    }
    correction = motionToFit() * correction;
  }
  findPairs(correction * T_first_second, kFinestGate);
  if (pairs_.empty()) {
    return {};
  }
  const Eigen::Isometry3d T_claimed_fitted = correction.inverse();
  double sum = 0.0;
  for (const Pair& pair : pairs_) {
    sum += (T_claimed_fitted * pair.point_of_second - pair.point_of_second).norm();
  }
  const auto pairs = static_cast<double>(pairs_.size());
  const bool within_reach = sum / pairs < 2.0 * kCoarsestGate;
  return within_reach ? Fit{pairs, sum / pairs} : Fit{};
}

void ViewAgreement::findPairs(const Eigen::Isometry3d& T_first_second, double gate)
{
  pairs_.clear();
  const Eigen::Isometry3d T_second_first = T_first_second.inverse();
  for (const SurfaceElement& second : second_.samples()) {
    if (const SurfaceElement* first = first_.closest(transformed(T_first_second, second))) {
      addPair(*first, second, T_first_second, gate);
    }
  }
  for (const SurfaceElement& first : first_.samples()) {
    if (const SurfaceElement* second = second_.closest(transformed(T_second_first, first))) {
      addPair(first, *second, T_first_second, gate);
    }
  }
}

/// The weight is Tukey's biweight over the variance of the distance: depth noise grows with the square of depth.
void ViewAgreement::addPair(const SurfaceElement& first, const SurfaceElement& second,
                            const Eigen::Isometry3d& T_first_second, double gate)
{
  const SurfaceElement moved = transformed(T_first_second, second);
  const Eigen::Vector3d normal = (first.normal + moved.normal).normalized();
  const double distance = (moved.point - first.point).dot(normal);
  const double root = 1.0 - distance * distance / (gate * gate);
  if (root > 0.0 && (moved.point - first.point).norm() < kCoarsestGate + gate) {
    const double variance = std::pow(first.point.z(), 4) + std::pow(second.point.z(), 4);
    pairs_.push_back({moved.point, normal, distance, root * root / variance});
  }
}

/// One Gauss-Newton step, in the directions that the pairs constrain.
Eigen::Isometry3d ViewAgreement::motionToFit() const
{
  double weights = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const Pair& pair : pairs_) {
    weights += pair.weight;
    center += pair.weight * pair.point_of_second;
  }
  center /= weights;
  double squares = 0.0;
  for (const Pair& pair : pairs_) {
    squares += pair.weight * (pair.point_of_second - center).squaredNorm();
  }
  const double radius = std::sqrt(squares / weights);  // makes turns comparable with shifts

  Matrix6d constraints = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  for (const Pair& pair : pairs_) {
    Vector6d row;
    row << ((pair.point_of_second - center) / radius).cross(pair.normal), pair.normal;
    constraints.noalias() += pair.weight / weights * row * row.transpose();
    gradient += pair.weight / weights * pair.distance * row;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(constraints);
  Vector6d twist = Vector6d::Zero();
  for (int i = 0; i < 6; ++i) {
    const Vector6d direction = eigen.eigenvectors().col(i);
    if (eigen.eigenvalues()[i] > kMinConstraint) {
      twist -= direction.dot(gradient) / eigen.eigenvalues()[i] * direction;
    }
  }
  twist.head<3>() /= radius;
  return rigidMotion(twist, center);
}

void ViewComparison::compare(const std::vector<ComparedView>& views, ThreadTeam& team)
{
  pairs_.resize(views.size() * (views.size() - 1) / 2);
  auto pair = pairs_.begin();
  for (std::size_t first = 0; first < views.size(); ++first) {
    for (std::size_t second = first + 1; second < views.size(); ++second, ++pair) {
      pair->first = first;
      pair->second = second;
    }
  }
  team.forEach(pairs_.size(), [&](std::size_t i, std::size_t) {
    Pair& compared = pairs_[i];
    const ComparedView &first = views[compared.first], &second = views[compared.second];
    compared.disagreement = first.image != nullptr && second.image != nullptr
                                ? compared.agreement.disagreement(*first.image, *second.image,
                                                                  first.T_common_view.inverse() * second.T_common_view)
                                : std::numeric_limits<double>::quiet_NaN();
  });
  disagreement_ = std::numeric_limits<double>::quiet_NaN();
  warnings_.clear();
  for (const Pair& compared : pairs_) {
    disagreement_ = std::fmax(disagreement_, compared.disagreement);
    constexpr double kMisplaced = 0.015;  // m; twice what exact poses were seen to cause
    if (compared.disagreement > kMisplaced) {
      warnings_.push_back("views " + std::to_string(views[compared.first].number) + " and " +
                          std::to_string(views[compared.second].number) + " place the same surfaces " +
                          std::to_string(std::lround(1000.0 * compared.disagreement)) +
                          " mm apart: their poses may be wrong");
    }
  }
}

}  // namespace grasp_affordances
