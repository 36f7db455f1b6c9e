#include "core/prepared_cloud.h"

#include "grasp_affordances/hidden_surfaces.h"
#include "grasp_affordances/sampling.h"

#include <algorithm>

namespace grasp_affordances
{
namespace
{

void findMeasured(const Cloud& cloud, std::vector<std::uint32_t>& measured)
{
  measured.clear();
  measured.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.measured(i)) {
      measured.push_back(static_cast<std::uint32_t>(i));
    }
  }
}

bool allCoincide(const Cloud& cloud, const std::vector<std::uint32_t>& points)
{
  const Eigen::Vector3f first = cloud.point(points.front());
  return std::all_of(points.begin(), points.end(), [&](std::uint32_t i) { return cloud.point(i) == first; });
}

}  // namespace

void PreparedCloud::update(const Cloud& new_cloud, const Config& config, ThreadTeam& team)
{
  cloud = &new_cloud;
  search = nullptr;
  sensor.setZero();
  image.reset();
  hidden_search.reset();
  candidates.clear();
  warnings.clear();
  findMeasured(*cloud, measured);
  if (measured.empty()) {
    warnings.emplace_back(cloud->size() == 0 ? "nothing to localize: the cloud is empty"
                                             : "nothing to localize: all points are NaN, zero or infinite");
    return;
  }
  if (allCoincide(*cloud, measured)) {
    warnings.emplace_back("nothing to localize: all measured points coincide");
    return;
  }

  std::string warning;
  image = RangeImage::create(*cloud, warning);
  if (image) {
    updateOrganized(config);
  } else {
    sensor = cloud->sensor_origin.cast<double>();
    tree_search_ = makeTreeSearch(*cloud);
    search = tree_search_.get();
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
    estimateNormals(config.estimation.normals_radius, team);
  }
}

void PreparedCloud::updateOrganized(const Config& config)
{
  search = &window_search_.emplace(*image, measured.size());
  if (config.sampling.screen) {
    candidates =
        screenPoints(*image, config.hand, static_cast<std::size_t>(config.sampling.samples), config.sampling.seed);
  }
  if (config.shell.continue_surfaces) {
    constexpr double kWidestBridge = 8.0;  // capture radii: what a hand can grasp, and the shadow beside it
    hidden = continueSurfaces(*image, kWidestBridge * config.hand.capture_radius);
    hidden_image = image->withCloud(hidden);
    hidden_search.emplace(*hidden_image, 0);
  }
}

void PreparedCloud::findNeighborhood(std::uint32_t point, const Config& config, Neighborhood& neighborhood) const
{
  const Eigen::Vector3f center = cloud->point(point);
  if (config.neighborhood.kind == NeighborhoodKind::knn) {
    search->nearest(center, static_cast<std::size_t>(config.neighborhood.k), neighborhood);
  } else {
    const double radius = config.neighborhood.radius > 0.0 ? config.neighborhood.radius : config.hand.capture_radius;
    search->withinRadius(center, static_cast<float>(radius), neighborhood);
  }
}

void PreparedCloud::estimateNormals(double radius, ThreadTeam& team)
{
  normals.reset(cloud->size());
  neighborhoods_.resize(team.size());
  team.forEach(measured.size(), [&](std::size_t i, std::size_t member) {
    const std::uint32_t point = measured[i];
    search->withinRadius(cloud->point(point), static_cast<float>(radius), neighborhoods_[member]);
    if (const auto normal = planeNormal(neighborhoods_[member])) {
      normals.set(point, *normal);
    }
  });
}

}  // namespace grasp_affordances
