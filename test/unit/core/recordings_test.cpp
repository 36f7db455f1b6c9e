#include "grasp_affordances/localizer.h"

#include "evaluation/judge.h"
#include "evaluation/recordings.h"
#include "io/bag.h"
#include "support/recordings.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

class TableTop : public testing::TestWithParam<const char*>
{
};

constexpr std::uint64_t kSeeds = 10;

/// The `localizer` preset with samples drawn evenly: what is said of single shells holds for these. Importance sampling
/// looks closely at what was mistaken once, and there what counts is what becomes a handle.
Config drawingEvenly()
{
  Config config = presetConfig("localizer");
  config.sampling.samples = 4000;
  config.sampling.importance = false;
  return config;
}

/// @throw std::invalid_argument for a scene that is not in labels.json
LabelledCloud recordedScene(const std::string& folder, const std::string& scene)
{
  for (const EvaluationFrame& frame : recordedFrames(folder + "/mosd/labels.json")) {
    if (frame.scene == scene) {
      return frame.load();
    }
  }
  throw std::invalid_argument(scene);
}

/// Calls visit(seed, verdicts) for the shells of each seed.
template <typename Visitor>
void judgeShells(const LabelledCloud& recorded, Visitor&& visit)
{
  const Judge judge(recorded.cloud, recorded.labels);
  Config config = drawingEvenly();
  config.hand.capture_radius = recorded.capture_radius;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    config.sampling.seed = seed;
    std::vector<Verdict> verdicts;
    for (const Shell& shell : Localizer(config).localize(recorded.cloud).shells) {
      verdicts.push_back(judge(shell));
    }
    visit(seed, verdicts);
  }
}

/// Every affordance that labels.json lists, in each of ten seeds; nothing on the scenes of boxes in the first five.
TEST_P(TableTop, HasItsAffordancesFound)
{
  REQUIRE_RECORDINGS(folder);
  const std::string scene = GetParam();
  const LabelledCloud recorded = recordedScene(folder, scene);
  judgeShells(recorded, [&](std::uint64_t seed, const std::vector<Verdict>& verdicts) {
    std::set<std::uint32_t> found;
    for (const Verdict& verdict : verdicts) {
      found.insert(verdict.affordance);
    }
    for (const Affordance& affordance : recorded.affordances) {
      EXPECT_EQ(found.count(affordance.label), 1U) << "affordance " << affordance.label << ", seed " << seed;
    }
    if ((scene == "learn5" || scene == "learn20") && seed <= 5) {
      EXPECT_TRUE(verdicts.empty()) << "seed " << seed;
    }
  });
}

/// The default preset: a right handle on every affordance, and no other; none on the scenes of boxes.
TEST_P(TableTop, HasAHandleOnEachAffordanceAndNoOther)
{
  REQUIRE_RECORDINGS(folder);
  const LabelledCloud recorded = recordedScene(folder, GetParam());
  const Judge judge(recorded.cloud, recorded.labels);
  Config config;
  config.hand.capture_radius = recorded.capture_radius;
  std::size_t right = 0, wrong = 0, missing = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    config.sampling.seed = seed;
    std::set<std::uint32_t> found;
    for (const GraspHandle& handle : Localizer(config).localize(recorded.cloud).handles) {
      const Verdict verdict = judge(handle);
      right += verdict.kind == Verdict::right ? 1 : 0;
      wrong += verdict.kind == Verdict::wrong ? 1 : 0;
      found.insert(verdict.affordance);
    }
    for (const Affordance& affordance : recorded.affordances) {
      missing += found.count(affordance.label) == 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(missing, 0U) << "in " << kSeeds << " seeds";
  EXPECT_LE(wrong, 1U) << "of " << right + wrong;
}

INSTANTIATE_TEST_SUITE_P(Recordings, TableTop,
                         testing::Values("learn5", "learn20", "learn31", "learn33", "learn38", "learn39", "learn40",
                                         "learn42", "learn43", "learn44"),
                         [](const testing::TestParamInfo<const char*>& info) { return info.param; });

TEST(Recordings, AtLeast97PercentOfTheShellsOnTableTopsAreRight)
{
  REQUIRE_RECORDINGS(folder);
  int right = 0, wrong = 0;
  for (const EvaluationFrame& frame : recordedFrames(folder + "/mosd/labels.json")) {
    judgeShells(frame.load(), [&](std::uint64_t, const std::vector<Verdict>& verdicts) {
      for (const Verdict& verdict : verdicts) {
        right += verdict.kind == Verdict::right ? 1 : 0;
        wrong += verdict.kind == Verdict::wrong ? 1 : 0;
      }
    });
  }
  EXPECT_GT(right, 1000);
  EXPECT_GE(right, 0.97 * (right + wrong)) << right << " right, " << wrong << " wrong";
}

/// The can: radius about 3 cm, on a table.
TEST(Recordings, SodaCanInTheBagIsFound)
{
  REQUIRE_RECORDINGS(folder);
  Config config = drawingEvenly();
  config.hand.capture_radius = 0.045;
  int clouds = 0;
  BagVisitor visitor;
  visitor.malformed = [](const std::string& reason, std::size_t, std::size_t) { FAIL() << reason; };
  visitor.cloud = [&](const sensor_msgs::PointCloud2& message, std::size_t, std::size_t) {
    ++clouds;
    Cloud cloud;
    cloudFromPointCloud2(message, cloud);
    const Localization result = Localizer(config).localize(cloud);
    ASSERT_FALSE(result.shells.empty());
    for (const Shell& shell : result.shells) {
      EXPECT_LT((shell.centroid - Eigen::Vector3d(-0.06, 0.15, 0.955)).norm(), 0.06);
      EXPECT_GT(shell.inner_radius, 0.025);
      EXPECT_LT(shell.inner_radius, 0.042);
    }
    Config by_default;
    by_default.hand.capture_radius = config.hand.capture_radius;
    const std::vector<GraspHandle> handles = Localizer(by_default).localize(cloud).handles;
    ASSERT_EQ(handles.size(), 1U);
    EXPECT_LT((handles[0].centroid - Eigen::Vector3d(-0.06, 0.15, 0.955)).norm(), 0.06);
    EXPECT_NEAR(handles[0].radius, 0.032, 0.004);
  };
  readBagClouds(folder + "/bags/soda_can.bag", "", visitor);
  EXPECT_EQ(clouds, 1);
}

}  // namespace
}  // namespace grasp_affordances::test
