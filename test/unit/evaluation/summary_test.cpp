#include "evaluation/summary.h"
#include "evaluation/statistics.h"
#include "support/evaluations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

TEST(Statistics, MeanHasTheIntervalOfStudentsT)
{
  const Mean result = mean({1.0, 2.0, 3.0});
  EXPECT_DOUBLE_EQ(result.value, 2.0);
  EXPECT_NEAR(result.interval.high - 2.0, 4.30265 / std::sqrt(3.0), 1e-5);  // t table, 2 degrees of freedom
  EXPECT_NEAR(2.0 - result.interval.low, 4.30265 / std::sqrt(3.0), 1e-5);
  EXPECT_TRUE(std::isnan(mean({1.0}).interval.low));
  EXPECT_TRUE(std::isnan(mean({}).value));
}

TEST(Statistics, MeanShareLeavesOutUnitsWithoutShells)
{
  const Mean result = meanShare({{1, 2}, {0, 0}, {4, 4}});
  EXPECT_DOUBLE_EQ(result.value, 0.75);
  EXPECT_EQ(result.count, 2U);
  EXPECT_DOUBLE_EQ(result.interval.low, 0.0) << "cut off";
  EXPECT_DOUBLE_EQ(result.interval.high, 1.0) << "cut off";
}

TEST(Statistics, PooledIntervalIsThatOfABinomialForUnitsOfOne)
{
  std::vector<Ratio> units(400, Ratio{1, 1});
  std::fill(units.begin(), units.begin() + 80, Ratio{0, 1});
  const Interval interval = pooledInterval(units);
  const double half = 1.96 * std::sqrt(0.8 * 0.2 / 400.0);
  // A quantile of 2000 draws is known to 0.04 of the interval, and shares come in steps of 1/400.
  EXPECT_NEAR(interval.low, 0.8 - half, 0.004);
  EXPECT_NEAR(interval.high, 0.8 + half, 0.004);
}

TEST(Statistics, PooledIntervalIsWiderWhereUnitsHoldMore)
{
  // The same 80 % as 20 units that are all right and 5 that are all wrong.
  std::vector<Ratio> units(25, Ratio{16, 16});
  std::fill(units.begin(), units.begin() + 5, Ratio{0, 16});
  const Interval interval = pooledInterval(units);
  EXPECT_LT(interval.low, 0.68);
  EXPECT_GT(interval.high, 0.92);
  EXPECT_TRUE(std::isnan(pooledInterval({{1, 2}}).low));
  EXPECT_TRUE(std::isnan(pooledInterval({{0, 0}, {0, 0}}).low));
}

TEST(Statistics, PairedDifferenceNeedsBothShares)
{
  const Mean result = pairedDifference({{4, 4}, {1, 1}, {3, 4}}, {{2, 4}, {0, 0}, {2, 4}});
  EXPECT_EQ(result.count, 2U);
  EXPECT_DOUBLE_EQ(result.value, 0.375);
}

TEST(Summary, PoolsPrecisionAndRecallOverRuns)
{
  const std::vector<SummaryRow> rows = summarize(makeEvaluation());
  ASSERT_EQ(rows.size(), 2U) << "a group of one scene has no row of its own";
  const Score& s = rows[0].score;
  EXPECT_EQ(s.precision.part, 3U);
  EXPECT_EQ(s.precision.whole, 4U);
  EXPECT_EQ(s.not_counted, 1U);
  EXPECT_DOUBLE_EQ(s.wrongPerRun(), 0.25);
  EXPECT_DOUBLE_EQ(s.unit_precision.value, 0.75) << "the frame without shells is left out";
  EXPECT_EQ(s.unit_precision.count, 1U);
  const auto recall = [&](const char* key) {
    for (std::size_t i = 0; i < kVisibilityClasses.size(); ++i) {
      if (std::string(kVisibilityClasses[i].key) == key) {
        return s.recall[i];
      }
    }
    throw std::invalid_argument(key);
  };
  EXPECT_EQ(recall("all").found.part, 3U);
  EXPECT_EQ(recall("all").found.whole, 6U);
  EXPECT_DOUBLE_EQ(recall("800").found.value(), 1.0);
  EXPECT_DOUBLE_EQ(recall("200").found.value(), 0.5);
  EXPECT_DOUBLE_EQ(recall("200_clear").found.value(), 1.0);
  EXPECT_DOUBLE_EQ(recall("below_800").found.value(), 0.25);
  EXPECT_NEAR(recall("below_800").chance, (1.0 - std::pow(0.9, 10) + 1.0 - std::pow(0.7, 10)) / 2, 1e-12);
}

TEST(Summary, CountsByWhatTheFirstViewAndTheOthersShow)
{
  Evaluation evaluation = makeEvaluation();
  evaluation.variations[1] = {evaluation.variations[0].config, 2};
  FrameResult& frame = evaluation.frames[0];
  frame.affordances.push_back(makeAffordance(3, 0, 1.0));
  frame.further_views = {{3000, {0, 50, 400}}, {1000, {0, 300, 0}}};
  frame.runs[1][0].shells = {judged(Verdict::right, 3)};
  evaluation.frames.resize(1);
  EXPECT_EQ(pointsIn(frame, 2), 4000U);
  EXPECT_EQ(visiblePoints(frame, 1, 3), 450U);
  EXPECT_EQ(visibleElsewhere(frame, 1), 300U);
  const std::vector<SummaryRow> rows = summarize(evaluation);
  EXPECT_FALSE(rows[1].taubin_difference);
  const auto& one = rows[0].score.recall;
  const auto& two = rows[1].score.recall;
  EXPECT_EQ(one[0].found.whole, 4U) << "what the first view does not show counts in no class but those of other views";
  ASSERT_EQ(kVisibilityClasses[5].key, std::string("hidden"));
  ASSERT_EQ(kVisibilityClasses[6].key, std::string("hardly_seen"));
  EXPECT_EQ(one[5].found.part, 0U);
  EXPECT_EQ(two[5].found.part, 1U);
  EXPECT_EQ(two[5].found.whole, 2U);
  EXPECT_EQ(two[6].found.whole, 4U);
  EXPECT_NEAR(two[5].chance, 1.0 - std::pow(0.9, 10), 1e-12);
}

TEST(Summary, ComparesWithTaubinUnitByUnit)
{
  const std::vector<SummaryRow> rows = summarize(makeEvaluation());
  EXPECT_FALSE(rows[0].taubin_difference);
  ASSERT_TRUE(rows[1].taubin_difference);
  EXPECT_EQ(rows[1].taubin_difference->count, 1U);
  EXPECT_DOUBLE_EQ(rows[1].taubin_difference->value, 0.25);
}

TEST(Summary, RunsOfASingleFrameAreItsUnits)
{
  Evaluation evaluation = makeEvaluation();
  evaluation.frames.resize(1);
  const Score score = summarize(evaluation)[0].score;
  EXPECT_EQ(score.unit_precision.count, 2U);
  EXPECT_DOUBLE_EQ(score.unit_precision.value, 0.75);
}

TEST(Summary, GroupsOfSeveralScenesArePooled)
{
  Evaluation evaluation = makeEvaluation();
  evaluation.frames[1].scene = "luggage";
  const std::vector<SummaryRow> rows = summarize(evaluation);
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_TRUE(rows[4].is_group);
  EXPECT_EQ(rows[4].scene, "paper");
  EXPECT_EQ(rows[4].score.frames, 2U);
}

}  // namespace
}  // namespace grasp_affordances::test
