// A small version of what `evaluate` measures, so that a loss is noticed: seeds that thresholds were not chosen on.

#include "evaluation/evaluation.h"
#include "simulation/paper_scenes.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

struct Score
{
  int right = 0, wrong = 0;
  int found = 0, affordances = 0;  // of those that show enough points
  int right_handles = 0, wrong_handles = 0;
  int with_one_handle = 0;  // of the affordances
  int frames = 0;
};

Score score(const std::vector<std::string>& scenes, const Config& config, std::size_t visible_points,
            double most_occluded)
{
  std::vector<EvaluationFrame> frames;
  for (const std::string& scene : scenes) {
    for (std::uint64_t seed = 201; seed <= 203; ++seed) {
      frames.push_back(renderedFrame("", scene, seed, GraspDefinition()));
    }
  }
  Score result;
  for (const FrameResult& frame : evaluate(frames, {{config}}, 1, 0, [] {})) {
    const Run& run = frame.runs.front().front();
    ++result.frames;
    for (const JudgedShell& judged : run.shells) {
      result.right += judged.verdict.kind == Verdict::right ? 1 : 0;
      result.wrong += judged.verdict.kind == Verdict::wrong ? 1 : 0;
    }
    for (const JudgedHandle& judged : run.handles) {
      result.right_handles += judged.verdict.kind == Verdict::right ? 1 : 0;
      result.wrong_handles += judged.verdict.kind == Verdict::wrong ? 1 : 0;
    }
    for (const Affordance& affordance : frame.affordances) {
      if (affordance.visible_points >= visible_points && affordance.occluded_share <= most_occluded) {
        ++result.affordances;
        result.found += finds(run, affordance.label) ? 1 : 0;
        result.with_one_handle += handlesOn(run, affordance.label) == 1 ? 1 : 0;
      }
    }
  }
  return result;
}

std::vector<std::string> paperSceneNames()
{
  std::vector<std::string> names;
  for (const NamedScene& scene : paperScenes()) {
    names.push_back(scene.name);
  }
  return names;
}

TEST(DetectionQuality, LocalizerOnThePapersScenes)
{
  const Score result = score(paperSceneNames(), Config(), 200, 0.5);
  EXPECT_GE(result.right, 0.98 * (result.right + result.wrong)) << result.right << " right, " << result.wrong;
  EXPECT_GE(result.found, 0.97 * result.affordances) << result.found << " of " << result.affordances;
  EXPECT_GT(result.affordances, 80);
  EXPECT_GT(result.right, 1000);
  EXPECT_GE(result.right_handles, 0.97 * (result.right_handles + result.wrong_handles)) << result.wrong_handles;
  EXPECT_GE(result.with_one_handle, 0.94 * result.affordances) << result.with_one_handle;
}

TEST(DetectionQuality, LocalizerFarAwayAndInClutter)
{
  for (const char* scene : {"far", "clutter"}) {
    const Score result = score({scene}, Config(), 200, 0.5);
    EXPECT_GE(result.right, 0.95 * (result.right + result.wrong)) << scene << ": " << result.wrong << " wrong";
    EXPECT_GE(result.found, 0.9 * result.affordances) << scene << ": " << result.found << " of " << result.affordances;
    EXPECT_GT(result.affordances, 5) << scene;
    EXPECT_GT(result.right, 50) << scene;
  }
}

TEST(DetectionQuality, LocalizerWhereNothingCanBeGrasped)
{
  // Drawn evenly: importance sampling looks closely at what was mistaken once, and finds more shells there. What counts
  // is then that hardly any of it becomes a handle.
  Config config;
  config.sampling.samples = 4000;
  config.sampling.importance = false;
  const Score result = score({"distractors"}, config, 1, 1.0);
  EXPECT_EQ(result.frames, 3);
  EXPECT_EQ(result.right, 0);
  EXPECT_EQ(result.affordances, 0);
  EXPECT_LE(result.wrong, 2 * result.frames);
  EXPECT_LE(result.wrong_handles, result.frames);
  const Score by_importance = score({"distractors"}, Config(), 1, 1.0);
  EXPECT_EQ(by_importance.right_handles, 0);
  EXPECT_LE(by_importance.wrong_handles, by_importance.frames);
}

TEST(DetectionQuality, PaperOnThePapersScenes)
{
  const Score result = score(paperSceneNames(), presetConfig("paper"), 800, 1.0);
  EXPECT_GE(result.right, 0.9 * (result.right + result.wrong)) << result.right << " right, " << result.wrong;
  EXPECT_GE(result.found, 0.9 * result.affordances) << result.found << " of " << result.affordances;
  EXPECT_GT(result.affordances, 50);
  EXPECT_GT(result.right, 300);
}

}  // namespace
}  // namespace grasp_affordances::test
