// What a second and a third view of the paper's ten scenes buy.

#include "evaluation/evaluation.h"
#include "evaluation/summary.h"
#include "simulation/placement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

/// Scenes with a seed that leaves something graspable hidden from the first camera; none of the seeds 101 to 180 does
/// so in cleaning1 and kitchen2.
const std::vector<std::pair<std::string, std::uint64_t>> kFrames = {
    {"mugs", 101},       {"cleaning1", 101}, {"kitchen1", 102}, {"cleaning2", 107}, {"household1", 114},
    {"household2", 101}, {"kitchen2", 101},  {"kitchen3", 102}, {"luggage", 177},   {"cleaning3", 123},
};

const std::vector<double> kTurns = {75.0 * kDegree, 0.0, -75.0 * kDegree};

const VisibilityClass& hiddenFromTheFirst()
{
  return *std::find_if(kVisibilityClasses.begin(), kVisibilityClasses.end(),
                       [](const VisibilityClass& visibility) { return visibility.key == std::string("hidden"); });
}

/// The frames with one, two and three views.
Evaluation evaluateViews()
{
  std::vector<EvaluationFrame> frames;
  for (const auto& [scene, seed] : kFrames) {
    frames.push_back(renderedFrame("paper", scene, seed, GraspDefinition(), kTurns));
  }
  Evaluation evaluation;
  for (const std::size_t views : {1, 2, 3}) {
    evaluation.variations.push_back({presetConfig("localizer"), views});
  }
  evaluation.runs = 1;
  evaluation.frames = evaluate(frames, evaluation.variations, evaluation.runs, 0, [] {});
  return evaluation;
}

/// Of the affordances that a visibility class holds, or of all, those that are found in a frame with so many views.
Ratio recall(const FrameResult& frame, std::size_t views, const VisibilityClass* visibility)
{
  Ratio recall;
  for (std::size_t i = 0; i < frame.affordances.size(); ++i) {
    const Affordance& affordance = frame.affordances[i];
    if (visibility == nullptr || visibility->holds(affordance, visibleElsewhere(frame, i))) {
      recall += {finds(frame.runs[views - 1].front(), affordance.label) ? std::size_t{1} : 0, 1};
    }
  }
  return recall;
}

class SeveralViews : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    evaluation_ = evaluateViews();
    for (const FrameResult& frame : evaluation_.frames) {
      frames_.push_back(&frame);
    }
  }

  static inline Evaluation evaluation_;
  static inline std::vector<const FrameResult*> frames_;
};

TEST_F(SeveralViews, FindWhatTheFirstCannotSee)
{
  std::vector<std::size_t> scenes;  // by the number of views less one
  for (const std::size_t views : {1, 2, 3}) {
    scenes.push_back(std::count_if(frames_.begin(), frames_.end(), [&](const FrameResult* frame) {
      return recall(*frame, views, &hiddenFromTheFirst()).part > 0;
    }));
  }
  EXPECT_EQ(scenes[0], 0U);
  EXPECT_GE(scenes[1], 8U);
  EXPECT_GE(scenes[2], 8U);
}

TEST_F(SeveralViews, FindMoreInAll)
{
  const auto found = [&](std::size_t views) {
    Ratio sum;
    for (const FrameResult* frame : frames_) {
      sum += recall(*frame, views, nullptr);
    }
    return sum;
  };
  EXPECT_GE(found(2).part, found(1).part + 8) << "of " << found(1).whole;
  EXPECT_GE(found(3).part, found(1).part + 8) << "of " << found(1).whole;
}

TEST_F(SeveralViews, AreNoLessPreciseThanOne)
{
  const Ratio one = score(frames_, 0, 1).precision;
  EXPECT_GT(one.whole, 1000U);
  for (const std::size_t views : {2, 3}) {
    const Ratio several = score(frames_, views - 1, views).precision;
    EXPECT_GT(several.whole, 1000U);
    EXPECT_GE(several.value(), one.value()) << views << " views: " << several.whole - several.part << " wrong of "
                                            << several.whole << ", " << one.whole - one.part << " of " << one.whole;
  }
}

}  // namespace
}  // namespace grasp_affordances::test
