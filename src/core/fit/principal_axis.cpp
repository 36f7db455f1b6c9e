#include "core/fit/principal_axis.h"

#include "core/fit/covariance.h"
#include "core/kernels/measured_kernels.h"
#include "core/kernels/moment_sums.h"

#include <algorithm>
#include <array>

namespace grasp_affordances
{

std::optional<Eigen::Vector3d> pointsAxis(const Neighborhood& neighborhood)
{
  return distinctEigenvector(covariance(neighborhood), Extreme::largest);
}

std::optional<Eigen::Vector3d> pointsAxis(const Moments& moments)
{
  const double n = moments.sum(0, 0, 0);
  const Eigen::Vector3d mean = Eigen::Vector3d(moments.sum(1, 0, 0), moments.sum(0, 1, 0), moments.sum(0, 0, 1)) / n;
  return distinctEigenvector(secondMoments(moments.sums().data()) / n - mean * mean.transpose(), Extreme::largest);
}

std::optional<Eigen::Vector3d> normalsAxis(const Neighborhood& neighborhood, const Normals& normals)
{
  return normalsAxis(normalsScatter(normals, neighborhood.index(), neighborhood.size()));
}

Eigen::Matrix3d normalsScatter(const Normals& normals, const std::uint32_t* points, std::size_t count)
{
  constexpr std::size_t kBatch = 256;
  std::array<std::array<float, kBatch>, 3> batch;
  const float* const all[] = {normals.x.data(), normals.y.data(), normals.z.data()};
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (std::size_t begin = 0; begin < count; begin += kBatch) {
    float* const gathered[] = {batch[0].data(), batch[1].data(), batch[2].data()};
    const std::size_t measured = gatherMeasured(all, points + begin, std::min(kBatch, count - begin), gathered);
    std::array<double, momentCount(2)> sums;
    sumMoments(gathered, measured, origin.data(), sums.data(), 2);
    scatter += secondMoments(sums.data());
  }
  return scatter;
}

std::optional<Eigen::Vector3d> normalsAxis(const Eigen::Matrix3d& scatter)
{
  return distinctEigenvector(scatter, Extreme::smallest);
}

}  // namespace grasp_affordances
