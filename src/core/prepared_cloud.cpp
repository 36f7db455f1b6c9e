#include "core/prepared_cloud.h"

#include "grasp_affordances/hidden_surfaces.h"
#include "grasp_affordances/sampling.h"

#include <algorithm>

namespace grasp_affordances
{
namespace
{

std::vector<std::uint32_t> measuredPoints(const Cloud& cloud)
{
  std::vector<std::uint32_t> measured;
  measured.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.measured(i)) {
      measured.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return measured;
}

bool allCoincide(const Cloud& cloud, const std::vector<std::uint32_t>& points)
{
  const Eigen::Vector3f first = cloud.point(points.front());
  return std::all_of(points.begin(), points.end(), [&](std::uint32_t i) { return cloud.point(i) == first; });
}

Normals estimateNormals(const PreparedCloud& prepared, double radius, ThreadTeam& team)
{
  Normals normals;
  normals.reset(prepared.cloud.size());
  std::vector<Neighborhood> neighborhoods(team.size());
  team.forEach(prepared.measured.size(), [&](std::size_t i, std::size_t member) {
    const std::uint32_t point = prepared.measured[i];
    prepared.search->withinRadius(prepared.cloud.point(point), static_cast<float>(radius), neighborhoods[member]);
    if (const auto normal = planeNormal(neighborhoods[member])) {
      normals.set(point, *normal);
    }
  });
  return normals;
}

}  // namespace

PreparedCloud::PreparedCloud(const Cloud& cloud, const Config& config, ThreadTeam& team)
    : cloud(cloud), measured(measuredPoints(cloud)), sensor(Eigen::Vector3d::Zero())
{
  if (measured.empty()) {
    warnings.emplace_back(cloud.size() == 0 ? "nothing to localize: the cloud is empty"
                                            : "nothing to localize: all points are NaN, zero or infinite");
    return;
  }
  if (allCoincide(cloud, measured)) {
    warnings.emplace_back("nothing to localize: all measured points coincide");
    return;
  }

  std::string warning;
  image = RangeImage::create(cloud, warning);
  if (image) {
    search = makeWindowSearch(*image, measured.size());
    if (config.sampling.screen) {
      candidates =
          screenPoints(*image, config.hand, static_cast<std::size_t>(config.sampling.samples), config.sampling.seed);
    }
    if (config.shell.continue_surfaces) {
      constexpr double kWidestBridge = 8.0;  // capture radii: what a hand can grasp, and the shadow beside it
      hidden = continueSurfaces(*image, kWidestBridge * config.hand.capture_radius);
      hidden_image = image->withCloud(hidden);
      hidden_search = makeWindowSearch(*hidden_image, 0);
    }
  } else {
    sensor = cloud.sensor_origin.cast<double>();
    search = makeTreeSearch(cloud);
    if (config.occlusion.filter || config.shell.require_observed_gap || config.sampling.screen ||
        config.shell.continue_surfaces || config.shell.min_coverage > 0.0) {
      warning +=
          "; without a range image occlusion and observed free space are not judged, nor is coverage; no surfaces "
          "are continued, and samples are drawn from all points";
    }
  }
  if (!warning.empty()) {
    warnings.push_back(warning);
  }
  if (config.estimation.estimator == Estimator::normals) {
    normals = estimateNormals(*this, config.estimation.normals_radius, team);
  }
}

}  // namespace grasp_affordances
