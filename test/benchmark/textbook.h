#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <Eigen/Core>

#include <optional>
#include <random>

/// Algorithm 1 of the paper as its sections read, built from what PCL, LAPACK and Eigen bring: the yardstick for speed.
///
/// PCL's search, LAPACK's generalized eigenproblem on the 10 x 10 matrices, Eigen's eigenvectors of the shape operator
/// at every drawn point; one thread. It is written with care (vectors of fixed size, memory that is kept from sample to
/// sample), but knows nothing beyond what the sections say. Its code stays as it is, so that ratios to it can be
/// compared over time.
namespace grasp_affordances::textbook
{

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

/// The same points, NaN where nothing was measured.
PclCloud::Ptr toPcl(const Cloud& cloud);

/// The points of a neighborhood as columns, centred on the sample and scaled by the neighborhood's radius.
using LocalPoints = Eigen::Matrix3Xd;

/// Coefficients c_1, ..., c_10 of equation 1.
struct QuadricFit
{
  Eigen::Matrix<double, 10, 1> c;
  double residual = 0.0;  ///< the smallest eigenvalue
};

/// Generalized eigenproblem (M - lambda N) c = 0 (section III-A) by LAPACK's dggev. Empty where no eigenvalue is
/// finite.
/// @throw std::runtime_error where LAPACK fails.
std::optional<QuadricFit> fitQuadric(const LocalPoints& points);

struct Curvature
{
  double magnitude = 0.0;  ///< of the larger principal curvature, in the inverse of the points' unit
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< unit, about which the surface curves most
};

/// The median of the curvature (section III-B) over `count` randomly drawn points put onto the quadric, over all of
/// them where there are no more. Empty where none of them stays in the neighborhood.
std::optional<Curvature> medianCurvature(const QuadricFit& quadric, const LocalPoints& points, int count,
                                         std::mt19937& random);

struct Circle
{
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< projection of the origin onto the circle's axis
  double radius = 0.0;
};

/// Algebraic circle through the points projected along the axis (section IV-A), in the points' unit.
Circle fitCircle(const LocalPoints& points, const Eigen::Vector3d& axis);

/// Localizes the affordances in a cloud, from its samples on as Localizer with the preset `paper`. Of the config it
/// reads what Algorithm 1 knows: samples and seed, hand, neighborhood, points in front, estimator, and the shell's
/// radius step, clearance length and counts of points.
class Pipeline
{
public:
  explicit Pipeline(Config config);

  Localization localize(const PclCloud::ConstPtr& cloud);

private:
  Config config_;
};

}  // namespace grasp_affordances::textbook
