#include "grasp_affordances/principal_axis.h"

#include "core/covariance.h"

#include <cmath>

namespace grasp_affordances
{

std::optional<Eigen::Vector3d> pointsAxis(const Neighborhood& neighborhood)
{
  return distinctEigenvector(covariance(neighborhood), Extreme::largest);
}

std::optional<Eigen::Vector3d> normalsAxis(const Neighborhood& neighborhood, const Normals& normals)
{
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < neighborhood.size(); ++i) {
    const Eigen::Vector3d normal = normals.normal(neighborhood.index()[i]).cast<double>();
    if (!std::isnan(normal.x())) {
      scatter += normal * normal.transpose();
    }
  }
  return distinctEigenvector(scatter, Extreme::smallest);
}

}  // namespace grasp_affordances
