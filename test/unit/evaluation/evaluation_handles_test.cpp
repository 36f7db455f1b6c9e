// How judged handles are counted and reported.
#include "evaluation/errors.h"
#include "evaluation/evaluation.h"
#include "evaluation/handle_score.h"
#include "evaluation/report.h"
#include "evaluation/summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

TEST(Statistics, QuantileLiesBetweenNeighbors)
{
  EXPECT_DOUBLE_EQ(quantile({4.0, 1.0, 2.0, 3.0}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({3.0, 1.0, 2.0}, 0.5), 2.0);
  EXPECT_DOUBLE_EQ(quantile({1.0, 0.0}, 0.9), 0.9);
  EXPECT_DOUBLE_EQ(quantile({5.0}, 0.9), 5.0);
  EXPECT_DOUBLE_EQ(quantile({1.0, 2.0}, 1.0), 2.0);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

JudgedHandle judged(Verdict::Kind kind, std::uint32_t affordance = 0, const HandleErrors& errors = HandleErrors())
{
  JudgedHandle result;
  result.verdict = {kind, affordance};
  result.errors = errors;
  return result;
}

HandleErrors errorsOf(double center, double axis, double radius)
{
  HandleErrors errors;
  errors.center = center;
  errors.axis = axis;
  errors.radius = radius;
  return errors;
}

Affordance affordance(std::uint32_t label, std::size_t visible_points, double occluded_share)
{
  Affordance result;
  result.label = label;
  result.object = "thing";
  result.visible_points = visible_points;
  result.occluded_share = occluded_share;
  return result;
}

Run runWith(const std::vector<JudgedHandle>& handles)
{
  Run run;
  run.handles = handles;
  return run;
}

/// One frame with three affordances, two runs: the first one finds 1 once and 2 twice, the second one finds 1 once.
Evaluation makeEvaluation()
{
  FrameResult frame;
  frame.scene = "mugs";
  frame.seed = 1;
  frame.points = 1000;
  frame.capture_radius = 0.026;
  frame.affordances = {affordance(1, 900, 0.1), affordance(2, 300, 0.8), affordance(3, 50, 0.0)};
  frame.runs = {{runWith({judged(Verdict::right, 1, errorsOf(0.001, 0.1, -0.002)),
                          judged(Verdict::right, 2, errorsOf(0.002, kUndefined, 0.001)),
                          judged(Verdict::right, 2, errorsOf(0.003, 0.3, -0.003)), judged(Verdict::wrong),
                          judged(Verdict::not_counted)}),
                 runWith({judged(Verdict::right, 1)})}};
  Evaluation evaluation;
  evaluation.variations.resize(1);
  evaluation.runs = 2;
  evaluation.frames = {frame};
  return evaluation;
}

const HandlesPerAffordance& ofClass(const HandleScore& score, std::string_view key)
{
  const auto found = std::find_if(kVisibilityClasses.begin(), kVisibilityClasses.end(),
                                  [&](const VisibilityClass& visibility) { return visibility.key == key; });
  return score.affordances.at(static_cast<std::size_t>(found - kVisibilityClasses.begin()));
}

TEST(HandleScore, CountsRightHandlesPerAffordanceAndRun)
{
  const HandleScore score = summarize(makeEvaluation()).at(0).handles;
  EXPECT_EQ(score.precision.part, 4U);
  EXPECT_EQ(score.precision.whole, 5U);
  EXPECT_EQ(score.not_counted, 1U);
  const auto expectCounts = [&](const char* key, std::size_t none, std::size_t one, std::size_t several) {
    const HandlesPerAffordance& counts = ofClass(score, key);
    EXPECT_EQ(counts.none, none) << key;
    EXPECT_EQ(counts.one, one) << key;
    EXPECT_EQ(counts.several, several) << key;
  };
  expectCounts("all", 3, 2, 1);
  expectCounts("200", 1, 2, 1);
  expectCounts("200_clear", 0, 2, 0);
  EXPECT_DOUBLE_EQ(ofClass(score, "200").exactlyOne().value(), 0.5);
  EXPECT_DOUBLE_EQ(ofClass(score, "200").found().value(), 0.75);
}

TEST(HandleScore, ErrorsAreThoseThatAreKnownOfRightHandles)
{
  const HandleScore score = summarize(makeEvaluation()).at(0).handles;
  EXPECT_EQ(score.center.count, 3U);
  EXPECT_DOUBLE_EQ(score.center.median, 0.002);
  EXPECT_NEAR(score.center.p90, 0.0028, 1e-12);
  EXPECT_EQ(score.axis.count, 2U) << "one has no direction";
  EXPECT_DOUBLE_EQ(score.axis.median, 0.2);
  EXPECT_DOUBLE_EQ(score.radius.median, 0.002) << "of the absolute values";
  EXPECT_DOUBLE_EQ(score.radius_bias, -0.002);
}

TEST(HandleScore, OfNoHandlesIsUndefined)
{
  Evaluation evaluation = makeEvaluation();
  evaluation.frames[0].runs = {{runWith({}), runWith({})}};
  const HandleScore score = summarize(evaluation).at(0).handles;
  EXPECT_TRUE(std::isnan(score.precision.value()));
  EXPECT_TRUE(std::isnan(score.center.median));
  EXPECT_EQ(ofClass(score, "all").none, 6U);
}

TEST(HandleReport, ShowsCountsAndErrorsInMillimetresAndDegrees)
{
  const Evaluation evaluation = makeEvaluation();
  const std::string tables = markdownTables(evaluation, summarize(evaluation));
  EXPECT_NE(tables.find("| mugs | 1 × 2 | 4 | 1 | 80.0"), std::string::npos) << tables;
  EXPECT_NE(tables.find("| 1 | 1 | 2.0 / 2.8 | 11.5 / 16.0 | 2.0 / 2.8 | -2.0 |"), std::string::npos) << tables;
  EXPECT_EQ(tables.find("Recall over"), std::string::npos) << "the sampling is not varied";
}

TEST(SampleReport, ComparesNumbersOfSamplesWithAndWithoutImportanceSampling)
{
  Evaluation evaluation = makeEvaluation();
  evaluation.variations.push_back(evaluation.variations[0]);
  evaluation.variations[1].config.sampling.samples = 500;
  evaluation.variations[1].config.sampling.importance = false;
  evaluation.frames[0].runs.push_back({runWith({}), runWith({})});
  const std::string tables = markdownTables(evaluation, summarize(evaluation));
  EXPECT_NE(tables.find("500 samples, importance sampling off"), std::string::npos) << tables;
  EXPECT_NE(tables.find("| mugs | localizer | taubin | 1 | 2000 | on | 0.0 | 0.0 | 0.0 | 50.0 | 75.0 | 100.0 | 33.3 |"),
            std::string::npos)
      << tables;
  EXPECT_NE(tables.find("| mugs | localizer | taubin | 1 | 500 | off | 0.0 |"), std::string::npos) << tables;
}

TEST(Errors, HandlesThatAreWrongMissingOrTooMany)
{
  Evaluation evaluation = makeEvaluation();
  Shell shell;
  evaluation.frames[0].runs[0][1].shells = {{shell, {Verdict::right, 2}}, {shell, {Verdict::right, 1}}};
  const auto ofKind = [&](Error::Kind kind) {
    std::vector<Error> errors = worstErrors(evaluation, 10);
    errors.erase(
        std::remove_if(errors.begin(), errors.end(), [kind](const Error& error) { return error.kind != kind; }),
        errors.end());
    return errors;
  };
  const auto wrong = ofKind(Error::wrong_handle);
  ASSERT_EQ(wrong.size(), 1U);
  EXPECT_EQ(wrong[0].index, 3U);
  const auto several = ofKind(Error::several_handles);
  ASSERT_EQ(several.size(), 1U);
  EXPECT_EQ(several[0].label, 2U);
  EXPECT_EQ(several[0].run, 0U);
  const auto no_handle = ofKind(Error::no_handle);
  ASSERT_EQ(no_handle.size(), 1U) << "what no shell finds is a miss";
  EXPECT_EQ(no_handle[0].label, 2U);
  EXPECT_EQ(no_handle[0].run, 1U);
}

}  // namespace
}  // namespace grasp_affordances::test
