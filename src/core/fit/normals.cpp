#include "core/fit/normals.h"

#include "core/fit/covariance.h"

#include <cmath>

namespace grasp_affordances
{

void Normals::reset(std::size_t points)
{
  const float nan = std::nanf("");
  x.assign(points, nan);
  y.assign(points, nan);
  z.assign(points, nan);
}

void Normals::set(std::size_t index, const Eigen::Vector3d& normal)
{
  x[index] = static_cast<float>(normal.x());
  y[index] = static_cast<float>(normal.y());
  z[index] = static_cast<float>(normal.z());
}

std::optional<Eigen::Vector3d> planeNormal(const Neighborhood& neighborhood)
{
  return distinctEigenvector(covariance(neighborhood), Extreme::smallest);
}

}  // namespace grasp_affordances
