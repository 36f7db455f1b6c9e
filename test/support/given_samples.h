#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include "core/cloud/range_image.h"
#include "core/handles/handle_finder.h"
#include "core/parallel/thread_team.h"
#include "core/parallel/time_budget.h"
#include "core/sample_loop.h"
#include "core/views/point_screen.h"
#include "core/views/prepared_views.h"
#include "support/points.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{

using MeasuredPoints = std::vector<PreparedViews::MeasuredPoint>;

/// Algorithm 1 with samples at given points, in place of drawn ones.
class GivenSamples
{
public:
  GivenSamples(const std::vector<PosedCloud>& clouds, Config config) : config_(std::move(config)), team_(1)
  {
    views_.update(clouds, config_, Eigen::Isometry3d::Identity(), team_);
  }

  std::vector<SampleResult> examine(const MeasuredPoints& points)
  {
    loop_.examine({views_, config_, team_, TimeBudget(0.0), Cancellation()}, points);
    return loop_.results();
  }

  /// The handles of these samples, without hand poses. The indices of their shells are those of the results.
  std::vector<GraspHandle> handles(const MeasuredPoints& points, const std::vector<SampleResult>& results)
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

  /// Indices of the points of a sample's neighborhood, in ascending order. For one cloud only.
  std::vector<std::uint32_t> neighborhood(const PreparedViews::MeasuredPoint& point)
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
  SampleLoop loop_;
  HandleFinder finder_;
  Neighborhood neighborhood_, part_;
};

/// One cloud in its own frame.
inline std::vector<PosedCloud> alone(const Cloud& cloud)
{
  return {{&cloud, Eigen::Isometry3d::Identity()}};
}

/// Draws points of an organized cloud. Three of four are points where it falls away on both sides, since the shells are
/// there.
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

inline MeasuredPoints samplesOf(const std::vector<std::uint32_t>& points, std::size_t view = 0)
{
  MeasuredPoints samples;
  for (const std::uint32_t point : points) {
    samples.push_back({view, point});
  }
  return samples;
}

}  // namespace grasp_affordances::test
