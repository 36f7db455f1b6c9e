#include "grasp_affordances/localizer.h"

#include "core/parallel/thread_team.h"
#include "core/parallel/time_budget.h"
#include "core/sample_loop.h"
#include "core/views/prepared_views.h"
#include "core/views/stratified_draw.h"
#include "support/points.h"
#include "support/scenes.h"
#include "support/shells.h"
#include "support/table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

using Pose = Eigen::Isometry3d;
using MeasuredPoint = PreparedViews::MeasuredPoint;

/// All rounds of a localization, one after another.
struct Drawing
{
  Drawing(const std::vector<PosedCloud>& clouds, const Config& config) : team(1)
  {
    views.update(clouds, config, Pose::Identity(), team);
    loop.run({views, config, team, TimeBudget(0.0), Cancellation()});
  }

  Drawing(const Cloud& cloud, const Config& config)
      : Drawing(std::vector<PosedCloud>{{&cloud, Pose::Identity()}}, config)
  {
  }

  std::vector<std::pair<std::size_t, std::uint32_t>> points() const
  {
    std::vector<std::pair<std::size_t, std::uint32_t>> result;
    for (std::size_t i = 0; i < draw.size(); ++i) {
      result.emplace_back(draw.points()[i].view, draw.points()[i].point);
    }
    return result;
  }

  ThreadTeam team;
  PreparedViews views;
  SampleLoop loop;
  const SampleDraw& draw = loop.draw();
  const std::vector<SampleResult>& results = loop.results();
  const std::vector<std::size_t>& rounds = loop.draw().roundEnds();  // samples drawn after each
};

void expectSums(const Localization& result, const Config& config, const std::string& what)
{
  EXPECT_EQ(result.sampled, static_cast<std::uint32_t>(config.sampling.samples)) << what;
  EXPECT_EQ(std::accumulate(result.counts.begin(), result.counts.end(), 0U), result.sampled) << what;
  EXPECT_EQ(result.counts[static_cast<std::size_t>(Outcome::shell)], result.shells.size()) << what;
}

TEST(ImportanceSampling, CountsAddUpOverAllRounds)
{
  const Cloud list = unorganized(table());
  Localizer localizer;
  for (const double first_share : {0.01, 0.6, 1.0}) {
    for (const double uniform_share : {0.0, 0.2, 1.0}) {
      for (const int samples : {1, 2, 7, 64, 1000}) {
        Config config;
        config.sampling.first_share = first_share;
        config.sampling.uniform_share = uniform_share;
        config.sampling.samples = samples;
        localizer.configure(config);
        const std::string what = std::to_string(samples) + " samples, first share " + std::to_string(first_share) +
                                 ", uniform share " + std::to_string(uniform_share);
        expectSums(localizer.localize(table()), config, what);
        if (samples < 1000) {
          expectSums(localizer.localize(list), config, what + ", unorganized");
        }
      }
    }
  }
  Config config;
  Localization result;
  Localizer(config).localize(tableFromTwoSides().posed(), result);
  expectSums(result, config, "two views");
  for (const Estimator estimator : {Estimator::pca, Estimator::normals}) {
    config.estimation.estimator = estimator;
    config.sampling.samples = 500;
    Localizer(config).localize(tableFromTwoSides().posed(), result);
    expectSums(result, config, "two views, another estimator");
  }
}

TEST(ImportanceSampling, TakesTheFirstShareInTheFirstRoundAndAllInThree)
{
  Config config;
  config.sampling.samples = 1000;
  for (const auto& [share, rounds] :
       {std::pair<double, std::vector<std::size_t>>{0.5, {500, 750, 1000}}, {0.999, {999, 1000}}, {1.0, {1000}}}) {
    config.sampling.first_share = share;
    EXPECT_EQ(Drawing(table(), config).rounds, rounds) << share;
  }
  config.sampling.importance = false;
  EXPECT_EQ(Drawing(table(), config).rounds, std::vector<std::size_t>{1000});
}

TEST(ImportanceSampling, SwitchedOffDrawsFromStrata)
{
  for (const bool screen : {false, true}) {
    Config config;
    config.sampling.importance = false;
    config.sampling.screen = screen;
    config.sampling.samples = 500;
    const Drawing drawing(table(), config);
    for (std::size_t i = 0; i < 500; ++i) {
      ASSERT_EQ(drawing.draw.points()[i].point, drawStratified(drawing.views[0].drawablePoints(),
                                                               drawing.views[0].screen.points(), config.sampling, i));
    }
  }
}

/// With a uniform share of one, and where no sample promises anything, later rounds go on as the first began.
TEST(ImportanceSampling, FallsBackToUniformDraws)
{
  const Cloud empty_table = captureScene("empty_table", 1).cloud;
  Config config;
  config.sampling.samples = 500;
  const auto uniform = [](const Cloud& cloud, Config plain) {
    plain.sampling.importance = false;
    return Drawing(cloud, plain).points();
  };
  const Drawing on_empty(empty_table, config);
  for (const SampleResult& result : on_empty.results) {
    ASSERT_NE(result.outcome, Outcome::shell);
  }
  config.hand.finger_thickness = 0.05;  // nothing has a gap as wide
  const Drawing of_nothing(empty_table, config);
  EXPECT_EQ(of_nothing.points(), uniform(empty_table, config));
  config = Config();
  config.sampling.samples = 500;
  config.sampling.uniform_share = 1.0;
  EXPECT_EQ(Drawing(table(), config).points(), uniform(table(), config));
}

TEST(ImportanceSampling, StaysWithinTheWorkspace)
{
  Config config;
  config.sampling.samples = 1000;
  const Localization everywhere = Localizer(config).localize(table());
  ASSERT_FALSE(everywhere.shells.empty());
  // A border right through something that can be grasped: draws near it would cross it.
  const Eigen::Vector3f middle = table().point(everywhere.shells[everywhere.shells.size() / 2].point_index);
  config.workspace.max_x = middle.x();
  config.workspace.min_y = middle.y() - 0.2F;
  const auto outside = [&](const Eigen::Vector3f& point) {
    return point.x() > middle.x() || point.y() < middle.y() - 0.2F;
  };
  std::size_t crossing = 0;
  for (const Shell& shell : everywhere.shells) {
    crossing += outside(table().point(shell.point_index)) ? 1 : 0;
  }
  ASSERT_GT(crossing, 0U);
  const Cloud list = unorganized(table());
  for (const Cloud* cloud : {&table(), &list}) {
    const Localization limited = Localizer(config).localize(*cloud);
    EXPECT_FALSE(limited.shells.empty());
    for (const Shell& shell : limited.shells) {
      EXPECT_FALSE(outside(cloud->point(shell.point_index)));
    }
    const Drawing drawing(*cloud, config);
    for (const auto& [view, point] : drawing.points()) {
      ASSERT_TRUE(cloud->measured(point));
      ASSERT_FALSE(outside(cloud->point(point)));
    }
  }
}

TEST(ImportanceSampling, DrawsMeasuredPointsOfAllViews)
{
  const Config config;
  const Drawing drawing(tableFromTwoSides().posed(), config);
  for (const auto& [view, point] : drawing.points()) {
    ASSERT_TRUE(drawing.views[view].cloud->measured(point));
  }
  // The two sides of the table have about as many candidates, and no round prefers one of them.
  std::size_t begin = 0;
  for (const std::size_t end : drawing.rounds) {
    const auto of_first = std::count_if(drawing.draw.points() + begin, drawing.draw.points() + end,
                                        [](const MeasuredPoint& sample) { return sample.view == 0; });
    const double share = static_cast<double>(of_first) / static_cast<double>(end - begin);
    EXPECT_GT(share, 0.25) << "samples " << begin << " to " << end;
    EXPECT_LT(share, 0.75) << "samples " << begin << " to " << end;
    begin = end;
  }
}

/// Share of the samples after the first round that are within a distance (m) of a shell of the first.
double shareNearShells(const Drawing& drawing, std::size_t first, double distance)
{
  const Cloud& cloud = *drawing.views[0].cloud;
  std::vector<Eigen::Vector3f> shells;
  for (std::size_t i = 0; i < first; ++i) {
    if (drawing.results[i].outcome == Outcome::shell) {
      shells.push_back(cloud.point(drawing.draw.points()[i].point));
    }
  }
  std::size_t near = 0;
  for (std::size_t i = first; i < drawing.draw.size(); ++i) {
    const Eigen::Vector3f point = cloud.point(drawing.draw.points()[i].point);
    near += std::any_of(shells.begin(), shells.end(),
                        [&](const Eigen::Vector3f& shell) { return (shell - point).norm() < distance; })
                ? 1
                : 0;
  }
  return static_cast<double>(near) / static_cast<double>(drawing.draw.size() - first);
}

TEST(ImportanceSampling, DrawsMoreSamplesNearShells)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Cloud cloud = captureScene("table", seed).cloud;
    Config config;
    config.sampling.samples = 400;
    config.sampling.first_share = 0.5;
    const double with = shareNearShells(Drawing(cloud, config), 200, 0.02);
    config.sampling.importance = false;
    const double without = shareNearShells(Drawing(cloud, config), 200, 0.02);
    EXPECT_GT(with, 1.3 * without) << "seed " << seed;
  }
}

TEST(ImportanceSampling, StaysNearTheSamplesThatItStartsFrom)
{
  Config config;
  config.sampling.samples = 400;
  config.sampling.first_share = 0.5;
  config.sampling.uniform_share = 0.0;
  config.sampling.spread = 0.0;
  const Drawing drawing(table(), config);
  // Without spread the draws near places are the samples themselves.
  std::size_t again = 0;
  for (std::size_t i = 200; i < 400; ++i) {
    const auto end = drawing.draw.points() + (i < drawing.rounds[1] ? 200 : drawing.rounds[1]);
    again += std::any_of(drawing.draw.points(), end,
                         [&](const MeasuredPoint& sample) { return sample.point == drawing.draw.points()[i].point; });
  }
  EXPECT_GT(again, 50U);
}

/// Normals that are estimated round by round are those that are estimated all at once.
TEST(ImportanceSampling, EstimatesTheNormalsThatEachRoundNeeds)
{
  const std::vector<PosedCloud> posed = tableFromTwoSides().posed();
  const std::vector<std::vector<PosedCloud>> moments = {{{&table(), Pose::Identity()}}, posed};
  for (const std::vector<PosedCloud>& clouds : moments) {
    for (const NormalsMode mode : {NormalsMode::exact, NormalsMode::sparse}) {
      Config config;
      config.estimation.estimator = Estimator::normals;
      config.estimation.normals_mode = mode;
      config.sampling.samples = 300;
      const Drawing by_round(clouds, config);
      ThreadTeam team(2);
      PreparedViews at_once;
      at_once.update(clouds, config, Pose::Identity(), team);
      SampleLoop loop;
      loop.examine({at_once, config, team, TimeBudget(0.0), Cancellation()},
                   {by_round.draw.points(), by_round.draw.points() + by_round.draw.size()});
      const std::vector<SampleResult>& expected = loop.results();
      ASSERT_EQ(expected.size(), by_round.results.size());
      ASSERT_EQ(by_round.rounds.size(), 3U);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        ASSERT_EQ(by_round.results[i].outcome, expected[i].outcome) << i;
        if (expected[i].outcome == Outcome::shell) {
          ASSERT_TRUE(same(by_round.results[i].shell, expected[i].shell)) << i;
        }
      }
      for (std::size_t view = 0; view < clouds.size(); ++view) {
        const Normals &rounds = by_round.views[view].normals.normals(), &all = at_once[view].normals.normals();
        std::size_t estimated = 0;
        for (std::uint32_t i = 0; i < clouds[view].cloud->size(); ++i) {
          estimated += std::isnan(all.x[i]) ? 0 : 1;
          ASSERT_TRUE((std::isnan(rounds.x[i]) && std::isnan(all.x[i])) || rounds.normal(i) == all.normal(i)) << i;
        }
        EXPECT_GT(estimated, 100U);
      }
    }
  }
}

}  // namespace
}  // namespace grasp_affordances::test
