#include "core/fit/quadric.h"
#include "io/pcd.h"
#include "support/points.h"
#include "support/recordings.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

/// Random neighborhoods of a cloud that can be fitted.
std::vector<Neighborhood> someNeighborhoods(const Cloud& cloud, std::size_t count, std::uint64_t seed)
{
  const auto search = makeTreeSearch(cloud);
  std::vector<Neighborhood> neighborhoods;
  for (std::uint64_t draw = 0; neighborhoods.size() < count; ++draw) {
    const std::uint32_t point = randomIndex(randomBits(seed, draw), static_cast<std::uint32_t>(cloud.size()));
    if (cloud.measured(point)) {
      Neighborhood neighborhood;
      search->withinRadius(cloud.point(point), 0.026F, neighborhood);
      if (neighborhood.size() >= 10) {
        neighborhoods.push_back(std::move(neighborhood));
      }
    }
  }
  return neighborhoods;
}

TEST(TaubinFitter, FitsSeveralAtOnceAsOneByOne)
{
  const auto neighborhoods = someNeighborhoods(captureScene("table", 1).cloud, TaubinFitter::kCapacity, 1);
  TaubinFitter fitter;
  for (const std::size_t count : {TaubinFitter::kCapacity, std::size_t{3}, std::size_t{1}, std::size_t{0}}) {
    fitter.clear();
    for (std::size_t i = 0; i < count; ++i) {
      fitter.add(Moments(neighborhoods[i]), neighborhoods[i].center.cast<double>(), neighborhoods[i].radius);
    }
    EXPECT_EQ(fitter.size(), count);
    fitter.fit();
    for (std::size_t i = 0; i < count; ++i) {
      const auto together = fitter[i], alone = fitTaubin(neighborhoods[i]);
      ASSERT_EQ(together.has_value(), alone.has_value());
      if (together) {
        EXPECT_EQ(together->residual, alone->residual);
        EXPECT_EQ(together->quadric.A, alone->quadric.A);
        EXPECT_EQ(together->quadric.b, alone->quadric.b);
        EXPECT_EQ(together->quadric.c, alone->quadric.c);
        EXPECT_EQ(together->quadric.origin, alone->quadric.origin);
        EXPECT_EQ(together->quadric.scale, alone->quadric.scale);
      }
    }
  }
}

/// Fits `count` neighborhoods and tells for how many the full eigenproblem had to be solved.
std::size_t solvedFully(const Cloud& cloud, std::size_t count)
{
  const auto neighborhoods = someNeighborhoods(cloud, count, 2);
  TaubinFitter fitter;
  for (std::size_t begin = 0; begin < count; begin += TaubinFitter::kCapacity) {
    fitter.clear();
    for (std::size_t i = begin; i < std::min(begin + TaubinFitter::kCapacity, count); ++i) {
      fitter.add(Moments(neighborhoods[i]), neighborhoods[i].center.cast<double>(), neighborhoods[i].radius);
    }
    fitter.fit();
  }
  return fitter.solvedFully();
}

TEST(TaubinFitter, SolvesHardlyEverTheFullProblemOnRenderedClouds)
{
  for (const char* scene : {"table", "cleaning2", "kitchen1"}) {
    EXPECT_LE(solvedFully(captureScene(scene, 1).cloud, 1000), 1U) << scene;
  }
}

TEST(TaubinFitter, SolvesHardlyEverTheFullProblemOnRecordedClouds)
{
  REQUIRE_RECORDINGS(folder);
  for (const char* name : {"learn33", "learn44"}) {
    EXPECT_LE(solvedFully(readPcdCloud(folder + "/mosd/" + name + ".pcd"), 1000), 1U) << name;
  }
}

}  // namespace
}  // namespace grasp_affordances::test
