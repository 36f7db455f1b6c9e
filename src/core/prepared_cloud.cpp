#include "core/prepared_cloud.h"

#include "grasp_affordances/occlusion.h"

#include "core/measured_kernels.h"

#include <algorithm>

namespace grasp_affordances
{

void PreparedCloud::update(const Cloud& new_cloud, const Config& config, ThreadTeam& team)
{
  cloud = &new_cloud;
  image.reset();
  search = nullptr;
  sensor.setZero();
  warnings.clear();
  listMeasured();
  if (measured.empty()) {
    warnings.emplace_back(cloud->size() == 0 ? "nothing to localize: the cloud is empty"
                                             : "nothing to localize: all points are NaN, zero or infinite");
    return;
  }
  if (allCoincide()) {
    warnings.emplace_back("nothing to localize: all measured points coincide");
    return;
  }

  std::string warning;
  image = RangeImage::create(*cloud, warning, &team);
  if (image) {
    search = &window_search_.emplace(*image, measured.size());
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
  if (image && config.sampling.screen) {
    screen.update(*image, config.hand, static_cast<std::size_t>(config.sampling.samples), config.sampling.seed, team);
  } else {
    screen.clear();
  }
  hidden_search.reset();
  if (image && config.shell.continue_surfaces) {
    constexpr double kWidestBridge = 8.0;  // capture radii: what a hand can grasp, and the shadow beside it
    hidden.update(*image, kWidestBridge * config.hand.capture_radius, team);
    hidden_image = image->withCloud(hidden.cloud());
    hidden_search.emplace(*hidden_image, 0);
  }
  if (config.estimation.estimator == Estimator::normals) {
    estimateNormals(config, team);
  }
}

void PreparedCloud::listMeasured()
{
  measured.resize(countMeasured(cloud->x.data(), cloud->size()));
  grasp_affordances::listMeasured(cloud->x.data(), cloud->size(), measured.data(), measured.size());
}

bool PreparedCloud::allCoincide() const
{
  const Eigen::Vector3f first = cloud->point(measured.front());
  return std::all_of(measured.begin(), measured.end(), [&](std::uint32_t i) { return cloud->point(i) == first; });
}

void PreparedCloud::findNeighborhood(std::uint32_t point, const Config& config, Neighborhood& neighborhood) const
{
  const Eigen::Vector3f center = cloud->point(point);
  if (config.neighborhood.kind == NeighborhoodKind::knn) {
    search->nearest(center, static_cast<std::size_t>(config.neighborhood.k), neighborhood);
  } else {
    search->withinRadius(center, neighborhoodRadius(config), neighborhood);
  }
}

/// Those of all points in the neighborhoods of the samples that are not occluded.
void PreparedCloud::estimateNormals(const Config& config, ThreadTeam& team)
{
  normals.reset(cloud->size());
  neighborhoods_.resize(team.size());
  team.forEach(static_cast<std::size_t>(config.sampling.samples), [&](std::size_t i, std::size_t member) {
    Neighborhood& neighborhood = neighborhoods_[member];
    findNeighborhood(samplePoint(config, i), config, neighborhood);
    const OcclusionConfig& occlusion = config.occlusion;
    const auto enough = static_cast<std::size_t>(occlusion.max_points_in_front);
    if (!image || !occlusion.filter || !occluded(*image, neighborhood, enough, occlusion.min_distance_in_front)) {
      normals.require(neighborhood);
    }
  });
  const bool sparse = config.estimation.normals_mode == NormalsMode::sparse;
  normals.compute(*cloud, *search, config.estimation.normals_radius, sparse ? SurfaceNormals::kSparseStride : 1, team);
}

}  // namespace grasp_affordances
