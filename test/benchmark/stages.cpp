#include "benchmark/stages.h"

#include "core/fit/circle.h"
#include "core/fit/normals.h"
#include "core/fit/principal_axis.h"
#include "core/neighborhoods/occlusion.h"
#include "core/parallel/random.h"
#include "core/views/hidden_surfaces.h"
#include "core/views/point_screen.h"
#include "grasp_affordances/point_cloud2.h"

#include <benchmark/benchmark.h>
#include <pcl/conversions.h>
#include <Eigen/Geometry>

#include <stdexcept>
#include <utility>

namespace grasp_affordances::test
{
namespace
{

constexpr std::size_t kSamples = 500;

RangeImage requireImage(const Cloud& cloud)
{
  std::string warning;
  const auto image = RangeImage::create(cloud, warning);
  if (!image) {
    throw std::runtime_error(warning);
  }
  return *image;
}

pcl::PointXYZ pclPoint(const Eigen::Vector3f& p)
{
  return {p.x(), p.y(), p.z()};
}

std::optional<FittedCylinder> fitCylinder(const Neighborhood& neighborhood, const Eigen::Vector3d& axis)
{
  const Eigen::Vector3d first = axis.unitOrthogonal(), second = axis.cross(first);
  const auto circle = fitCircle(neighborhood, first, second);
  if (!circle) {
    return std::nullopt;
  }
  const Eigen::Vector3d sample = neighborhood.center.cast<double>();
  return FittedCylinder{sample + circle->center.x() * first + circle->center.y() * second, axis, circle->radius};
}

void searchShell(Workbench& bench, const Config& config, const NeighborhoodSearch* hidden)
{
  const StageSample& sample = bench.nextCurvedSample();
  const double spacing = bench.image.spacing(sample.neighborhood.center.z());
  benchmark::DoNotOptimize(bench.shell_search.search({*bench.search, hidden, &bench.image, spacing}, sample.cylinder,
                                                     config.hand, config.shell));
}

std::vector<Stage> sampleStages()
{
  return {
      {"sample/neighborhood",
       [](Workbench& bench) {
         const Neighborhood& neighborhood = bench.nextSample().neighborhood;
         bench.search->withinRadius(neighborhood.center, neighborhood.radius, bench.neighborhood);
       }},
      {"sample/neighborhood_500_nearest",
       [](Workbench& bench) {
         bench.search->nearest(bench.nextSample().neighborhood.center, 500, bench.neighborhood);
       }},
      {"sample/occlusion",
       [](Workbench& bench) {
         const auto points_in_front = static_cast<std::size_t>(bench.paper.occlusion.max_points_in_front);
         benchmark::DoNotOptimize(occluded(bench.image, bench.nextSample().neighborhood, points_in_front, 0.0));
       }},
      {"sample/quadric",
       [](Workbench& bench) { benchmark::DoNotOptimize(fitTaubin(bench.nextSample().neighborhood)); }},
      {"sample/moments", [](Workbench& bench) { benchmark::DoNotOptimize(Moments(bench.nextSample().neighborhood)); }},
      {"sample/quadric_from_moments",
       [](Workbench& bench) {
         const StageSample& sample = bench.nextSample();
         benchmark::DoNotOptimize(
             fitTaubin(sample.moments, sample.neighborhood.center.cast<double>(), sample.neighborhood.radius));
       }},
      {"sample/quadric_from_moments_in_blocks",
       [](Workbench& bench) {
         const StageSample& sample = bench.nextSample();
         bench.fitter.add(sample.moments, sample.neighborhood.center.cast<double>(), sample.neighborhood.radius);
         if (bench.fitter.size() == TaubinFitter::kCapacity) {
           bench.fitter.fit();
           bench.fitter.clear();
         }
       }},
      {"sample/median_curvature",
       [](Workbench& bench) {
         const StageSample& sample = bench.nextSample();
         benchmark::DoNotOptimize(medianCurvature(sample.fit.quadric, sample.neighborhood, {Eigen::Vector3d::Zero()},
                                                  {50, 1}, bench.curvature_scratch));
       }},
      {"sample/pca_axis",
       [](Workbench& bench) { benchmark::DoNotOptimize(pointsAxis(bench.nextSample().neighborhood)); }},
      {"sample/plane_normal",
       [](Workbench& bench) { benchmark::DoNotOptimize(planeNormal(bench.nextSample().neighborhood)); }},
      {"sample/circle",
       [](Workbench& bench) {
         const StageSample& sample = bench.nextSample();
         benchmark::DoNotOptimize(fitCylinder(sample.neighborhood, sample.curvature.axis));
       }},
      {"sample/shell_search", [](Workbench& bench) { searchShell(bench, bench.paper, nullptr); }},
      {"sample/shell_search_localizer",
       [](Workbench& bench) { searchShell(bench, bench.localizer, bench.hidden_search.get()); }},
  };
}

std::vector<Stage> textbookStages()
{
  return {
      {"sample/neighborhood/textbook",
       [](Workbench& bench) {
         const Neighborhood& neighborhood = bench.nextSample().neighborhood;
         bench.pcl_search.radiusSearch(pclPoint(neighborhood.center), neighborhood.radius, bench.indices,
                                       bench.squared_distances);
       }},
      {"sample/neighborhood_500_nearest/textbook",
       [](Workbench& bench) {
         bench.pcl_search.nearestKSearch(pclPoint(bench.nextSample().neighborhood.center), 500, bench.indices,
                                         bench.squared_distances);
       }},
      {"sample/quadric/textbook",
       [](Workbench& bench) { benchmark::DoNotOptimize(textbook::fitQuadric(bench.nextSample().local_points)); }},
      {"sample/median_curvature/textbook",
       [](Workbench& bench) {
         const StageSample& sample = bench.nextSample();
         benchmark::DoNotOptimize(
             textbook::medianCurvature(sample.textbook_fit, sample.local_points, 50, bench.random));
       }},
      {"sample/circle/textbook",
       [](Workbench& bench) {
         const StageSample& sample = bench.nextSample();
         benchmark::DoNotOptimize(textbook::fitCircle(sample.local_points, sample.curvature.axis));
       }},
  };
}

std::vector<Stage> cloudStages()
{
  return {
      {"cloud/from_point_cloud2", [](Workbench& bench) { cloudFromPointCloud2(bench.message, bench.converted); }},
      {"cloud/range_image", [](Workbench& bench) { benchmark::DoNotOptimize(requireImage(bench.cloud)); }},
      {"cloud/screening",
       [](Workbench& bench) {
         const auto enough = static_cast<std::size_t>(bench.localizer.sampling.samples);
         benchmark::DoNotOptimize(screenPoints(bench.image, bench.localizer.hand, enough, 1));
       }},
      {"cloud/hidden_surfaces",
       [](Workbench& bench) {
         benchmark::DoNotOptimize(continueSurfaces(bench.image, bench.localizer.shell.max_length));
       }},
  };
}

}  // namespace

Workbench::Workbench(const Cloud& new_cloud)
    : cloud(new_cloud),
      paper(presetConfig("paper")),
      localizer(presetConfig("localizer")),
      image(requireImage(cloud)),
      hidden(continueSurfaces(image, 0.12)),
      hidden_image(image.withCloud(hidden)),
      pcl_cloud(textbook::toPcl(cloud))
{
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (cloud.measured(i)) {
      measured.push_back(i);
    }
  }
  search = makeWindowSearch(image, measured.size());
  std::size_t hidden_points = 0;
  for (std::size_t i = 0; i < hidden.size(); ++i) {
    hidden_points += hidden.measured(i) ? 1 : 0;
  }
  hidden_search = makeWindowSearch(hidden_image, hidden_points);
  pcl::toPCLPointCloud2(*pcl_cloud, message);
  pcl_search.setInputCloud(pcl_cloud);
  for (std::uint64_t i = 0; i < 10 * kSamples && samples_.size() < kSamples; ++i) {
    addSample(measured[randomIndex(randomBits(1, i), static_cast<std::uint32_t>(measured.size()))]);
  }
  if (samples_.empty() || curved_.empty()) {
    throw std::runtime_error("a cloud without a curved surface");
  }
}

void Workbench::addSample(std::uint32_t point)
{
  search->withinRadius(cloud.point(point), static_cast<float>(paper.hand.capture_radius), neighborhood);
  const auto fit = fitTaubin(neighborhood);
  if (!fit) {
    return;
  }
  const auto curvature =
      medianCurvature(fit->quadric, neighborhood, {Eigen::Vector3d::Zero()}, {50, 1}, curvature_scratch);
  const auto cylinder = curvature ? fitCylinder(neighborhood, curvature->axis) : std::nullopt;
  if (!cylinder) {
    return;
  }
  textbook::LocalPoints local_points(3, neighborhood.size());
  for (std::size_t i = 0; i < neighborhood.size(); ++i) {
    local_points.col(static_cast<Eigen::Index>(i)) =
        (neighborhood.point(i) - neighborhood.center).cast<double>() / neighborhood.radius;
  }
  const auto textbook_fit = textbook::fitQuadric(local_points);
  if (!textbook_fit) {
    return;
  }
  if (curvature->median >= 1.0 / paper.hand.capture_radius && cylinder->radius <= paper.hand.capture_radius) {
    curved_.push_back(samples_.size());
  }
  samples_.push_back(
      {neighborhood, Moments(neighborhood), *fit, *curvature, *cylinder, std::move(local_points), *textbook_fit});
}

const std::vector<Stage>& stages()
{
  static const std::vector<Stage> all = [] {
    std::vector<Stage> stages = sampleStages();
    for (const std::vector<Stage>& more : {textbookStages(), cloudStages()}) {
      stages.insert(stages.end(), more.begin(), more.end());
    }
    return stages;
  }();
  return all;
}

}  // namespace grasp_affordances::test
