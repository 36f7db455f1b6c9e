#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include "core/cloud/range_image.h"
#include "core/handles/handle_finder.h"
#include "core/parallel/thread_team.h"
#include "core/parallel/time_budget.h"
#include "core/sample_block.h"
#include "core/views/prepared_views.h"
#include "core/views/sampling.h"
#include "support/points.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{

using SamplePoints = std::vector<PreparedViews::SamplePoint>;

/// Algorithm 1 from the neighborhoods on, with samples that are given rather than drawn.
class GivenSamples
{
public:
  GivenSamples(const std::vector<PosedCloud>& clouds, Config config) : config_(std::move(config)), team_(1)
  {
    views_.update(clouds, config_, Eigen::Isometry3d::Identity(), team_);
  }

  std::vector<SampleResult> examine(const SamplePoints& points)
  {
    if (config_.estimation.estimator == Estimator::normals) {
      views_.estimateNormals(config_, points.data(), points.size(), team_);
    }
    std::vector<SampleResult> results(points.size());
    for (std::size_t begin = 0; begin < points.size(); begin += SampleBlock::kSamples) {
      const std::size_t end = std::min(begin + SampleBlock::kSamples, points.size());
      block_.examine(views_, config_, begin, end, points.data() + begin, results.data() + begin, TimeBudget(0.0));
    }
    return results;
  }

  /// The handles of these samples, without hand poses. Their shells count the results.
  std::vector<GraspHandle> handles(const SamplePoints& points, const std::vector<SampleResult>& results)
  {
    std::vector<Shell> shells;
    std::vector<std::uint32_t> samples;
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (results[i].outcome == Outcome::shell) {
        shells.push_back(results[i].shell);
        samples.push_back(static_cast<std::uint32_t>(i));
      }
    }
    std::vector<GraspHandle> handles;
    finder_.find(views_, config_, {points.data(), points.size(), shells}, handles);
    for (GraspHandle& handle : handles) {
      for (std::uint32_t& shell : handle.shells) {
        shell = samples[shell];
      }
    }
    return handles;
  }

  /// Points of a sample's neighborhood by their indices, in ascending order. Of one cloud only.
  std::vector<std::uint32_t> neighborhood(const PreparedViews::SamplePoint& point)
  {
    SphereView sphere;
    views_.gather(point, config_, true, neighborhood_, &sphere, part_);
    std::vector<std::uint32_t> points(neighborhood_.index(), neighborhood_.index() + neighborhood_.size());
    std::sort(points.begin(), points.end());
    return points;
  }

  const PreparedViews& views() const { return views_; }

private:
  Config config_;
  ThreadTeam team_;
  PreparedViews views_;
  SampleBlock block_;
  HandleFinder finder_;
  Neighborhood neighborhood_, part_;
};

/// One cloud in its own frame.
inline std::vector<PosedCloud> alone(const Cloud& cloud)
{
  return {{&cloud, Eigen::Isometry3d::Identity()}};
}

/// Points of an organized cloud, three in four where it falls away on both sides, for there are the shells.
inline std::vector<std::uint32_t> somePoints(const Cloud& cloud, const Config& config, std::size_t count,
                                             Random& random)
{
  std::vector<std::uint32_t> measured;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (cloud.measured(i)) {
      measured.push_back(i);
    }
  }
  std::string warning;
  const auto image = RangeImage::create(cloud, warning);
  const std::vector<std::uint32_t> screened =
      image ? screenPoints(*image, config.hand, cloud.size(), 1) : std::vector<std::uint32_t>();
  const auto draw = [&](const std::vector<std::uint32_t>& from) {
    return from[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(from.size())))];
  };
  std::vector<std::uint32_t> points;
  while (points.size() < count) {
    points.push_back(draw(points.size() % 4 == 0 || screened.empty() ? measured : screened));
  }
  return points;
}

inline SamplePoints samplesOf(const std::vector<std::uint32_t>& points, std::size_t view = 0)
{
  SamplePoints samples;
  for (const std::uint32_t point : points) {
    samples.push_back({view, point});
  }
  return samples;
}

}  // namespace grasp_affordances::test
