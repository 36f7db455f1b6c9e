#include "evaluation/suite.h"

#include "evaluation/error_causes.h"
#include "evaluation/seed_list.h"
#include "evaluation/suite_cell.h"
#include "evaluation/suite_numbers.h"
#include "evaluation/suite_store.h"
#include "evaluation/suite_table.h"
#include "simulation/background.h"
#include "simulation/sensor_model.h"
#include "support/evaluations.h"
#include "support/test_with_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

using Json = nlohmann::json;

const std::string kGrid =
    "seeds: [1:2, 7]\n"
    "presets: [paper, localizer]\n"
    "grid:\n"
    "  - {families: [paper], scenes: [table], sensors: [xtion, ideal], backgrounds: [open]}\n"
    "  - {families: paper, sensors: xtion, backgrounds: all, capture_radii: [0.026, 0.045], runs: 2}\n";

TEST(Suite, HasTheCellsOfItsGridOnceAndInOrder)
{
  const std::vector<SuiteCell> cells = suiteFromYaml(kGrid);
  std::vector<std::string> names;
  for (const SuiteCell& cell : cells) {
    names.push_back(cell.row + " " + cell.sensor + " " + cell.background + " " +
                    std::to_string(std::lround(1000.0 * cell.capture_radius)));
  }
  const std::vector<std::string> expected{"paper xtion open 26", "paper ideal open 26",  "table xtion open 26",
                                          "table ideal open 26", "paper xtion walls 26", "paper xtion far 26",
                                          "paper xtion room 26", "paper xtion dark 26",  "paper xtion walls 45",
                                          "paper xtion open 45", "paper xtion far 45",   "paper xtion room 45",
                                          "paper xtion dark 45"};
  EXPECT_EQ(names, expected) << "the Xtion before nothing is in both entries";
  EXPECT_EQ(cells.front().seeds, (std::vector<std::uint64_t>{1, 2, 7}));
  EXPECT_EQ(cells.front().presets, (std::vector<std::string>{"paper", "localizer"}));
  EXPECT_EQ(cells.front().runs, 1U);
  EXPECT_EQ(cells.back().runs, 2U);
  EXPECT_EQ(cells.front().scenes.size(), 10U);
  EXPECT_EQ(framesOf(cells.front()).size(), 30U);
}

TEST(Suite, RefusesWhatItDoesNotKnow)
{
  const auto expectRefused = [](const std::string& text, const std::string& reason) {
    try {
      suiteFromYaml(text);
      ADD_FAILURE() << text;
    } catch (const std::invalid_argument& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find(reason), std::string::npos) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    }
  };
  const auto entry = [](const std::string& keys) { return "grid: [{scenes: [table], " + keys + "}]"; };
  expectRefused("- 1", "no YAML map");
  expectRefused("{", "");
  expectRefused("seeds: 1:3", "grid");
  expectRefused("grid: []", "grid");
  expectRefused("grid: [7]", "no YAML map");
  expectRefused("grid: [{sensors: [xtion]}]", "neither families nor scenes");
  expectRefused("grid: [{families: [attic]}]", "'attic'");
  expectRefused("grid: [{scenes: [attic]}]", "'attic'");
  expectRefused(entry("sensors: [eye]"), "'eye'");
  expectRefused(entry("backgrounds: [sea]"), "'sea'");
  expectRefused(entry("presets: [best]"), "'best'");
  expectRefused(entry("capture_radii: [-1]"), "hand/capture_radius");
  expectRefused(entry("seeds: 5:1"), "'5:1'");
  expectRefused(entry("seeds: [1, 1:3]"), "twice");
  expectRefused(entry("runs: 0"), "runs");
  expectRefused(entry("colour: red"), "'colour'");
  EXPECT_THROW(suiteFromNameOrFile("best"), std::invalid_argument);
  EXPECT_THROW(suiteFromNameOrFile("absent.yaml"), std::invalid_argument);
}

TEST(Suite, ShortHasEverySensorBeforeNothingAndTheXtionBeforeEverything)
{
  std::set<std::pair<std::string, std::string>> columns;
  for (const SuiteCell& cell : suiteFromNameOrFile("short")) {
    if (cell.row == "paper") {
      columns.insert({cell.sensor, cell.background});
      EXPECT_EQ(cell.seeds.size(), 10U);
      EXPECT_EQ(cell.presets.size(), 2U);
    }
  }
  for (const std::string& sensor : sensorNames()) {
    EXPECT_EQ(columns.count({sensor, "open"}), 1U) << sensor;
  }
  for (const std::string& background : backgroundNames()) {
    EXPECT_EQ(columns.count({"xtion", background}), 1U) << background;
  }
}

TEST(Suite, AllKnownOnesCanBeRead)
{
  for (const std::string& name : suiteNames()) {
    EXPECT_FALSE(suiteFromNameOrFile(name).empty()) << name;
  }
}

TEST(SampleEnds, AreThoseOfTheSamplesOnAnAffordance)
{
  Config config = fewSamples();
  const auto frames = evaluate({barFrame(1)}, {{config, 1}}, 1, 1, [] {});
  const auto& run = frames.front().runs[0][0];
  ASSERT_EQ(run.ends.size(), 1U) << "every point is on the bar";
  const OutcomeCounts& ends = run.ends.at(1);
  EXPECT_EQ(std::accumulate(ends.begin(), ends.end(), 0U), run.sampled);
  EXPECT_EQ(ends[static_cast<std::size_t>(Outcome::shell)], run.shells.size());
  EXPECT_GT(run.shells.size(), 0U);
}

TEST(SampleEnds, OnPointsOfASecondViewAreThoseOfItsLabels)
{
  EvaluationFrame frame = barFrame(1);
  frame.load = [load = frame.load] {
    LabelledCloud labelled = load();
    FurtherView view{labelled.cloud, Eigen::Isometry3d::Identity(), Labels(labelled.cloud.size(), 2)};
    std::fill(labelled.labels.begin(), labelled.labels.end(), kNotGraspable);
    labelled.further_views.push_back(view);
    return labelled;
  };
  const auto frames = evaluate({frame}, {{fewSamples(), 2}}, 1, 1, [] {});
  const auto& run = frames.front().runs[0][0];
  ASSERT_EQ(run.ends.size(), 1U);
  const OutcomeCounts& ends = run.ends.at(2);
  const auto samples = std::accumulate(ends.begin(), ends.end(), 0U);
  EXPECT_GT(samples, run.sampled / 4);
  EXPECT_LT(samples, run.sampled * 3 / 4);
}

TEST(Evaluate, WrongShellsTellWhatTheyAreOn)
{
  EvaluationFrame frame = barFrame(1);
  frame.load = [load = frame.load] {
    LabelledCloud labelled = load();
    std::fill(labelled.labels.begin(), labelled.labels.end(), kNotGraspable);
    labelled.objects.assign(labelled.cloud.size(), 1);
    labelled.object_names = {"table", "post", ""};
    return labelled;
  };
  const auto frames = evaluate({frame}, {{fewSamples(), 1}}, 1, 1, [] {});
  const auto& run = frames.front().runs[0][0];
  ASSERT_FALSE(run.shells.empty());
  for (const JudgedShell& judged : run.shells) {
    EXPECT_EQ(judged.object, "post");
  }
  for (const JudgedHandle& judged : run.handles) {
    EXPECT_EQ(judged.object, "post");
  }
  const auto right = evaluate({barFrame(1)}, {{fewSamples(), 1}}, 1, 1, [] {});
  EXPECT_EQ(right.front().runs[0][0].shells.front().object, "") << "of a right one";
}

TEST(RenderedFrame, IsOfTheSensorAndBackgroundThatAreAskedFor)
{
  const auto measured = [](const EvaluationFrame& frame) {
    const LabelledCloud labelled = frame.load();
    std::size_t points = 0;
    for (std::size_t i = 0; i < labelled.cloud.size(); ++i) {
      points += labelled.cloud.measured(i) ? 1 : 0;
    }
    EXPECT_EQ(labelled.objects.size(), labelled.cloud.size());
    return std::make_pair(labelled.cloud.width, points);
  };
  const std::vector<double> ahead{0.0};
  const auto plain = measured(renderedFrame("", "table", 1, GraspDefinition()));
  const auto walls =
      measured(renderedFrame("", "table", 1, GraspDefinition(), ahead, sensorModel("xtion"), Background::walls));
  const auto open =
      measured(renderedFrame("", "table", 1, GraspDefinition(), ahead, sensorModel("xtion"), Background::open));
  const auto kinect =
      measured(renderedFrame("", "table", 1, GraspDefinition(), ahead, sensorModel("kinect_v2"), Background::walls));
  EXPECT_EQ(plain, walls);
  EXPECT_LT(open.second, walls.second * 3 / 4);
  EXPECT_NE(kinect.first, walls.first);
}

/// One frame of one run with an error of each kind.
Evaluation withErrors()
{
  Evaluation evaluation;
  evaluation.runs = 1;
  evaluation.variations.resize(1);
  FrameResult frame = makeFrame("mugs", 1);
  frame.capture_radius = 0.026;
  frame.affordances = {makeAffordance(1, 900, 0.1), makeAffordance(2, 300, 0.1), makeAffordance(3, 100, 0.1)};
  Run run{{judged(Verdict::right, 2), judged(Verdict::wrong)}, 10};
  run.shells.back().object = "table";
  run.ends[1][static_cast<std::size_t>(Outcome::low_curvature)] = 5;
  run.ends[1][static_cast<std::size_t>(Outcome::unobserved_gap)] = 7;
  run.ends[2][static_cast<std::size_t>(Outcome::shell)] = 1;
  run.ends[3][static_cast<std::size_t>(Outcome::occluded)] = 4;
  GraspHandle handle;
  handle.score = 0.95;
  run.handles = {{handle, {Verdict::wrong, 0}, {}, 0, "door"}};
  frame.runs = {{run}};
  evaluation.frames = {frame};
  return evaluation;
}

TEST(ErrorCauses, AreTheStageTheKindAndTheObject)
{
  const Evaluation evaluation = withErrors();
  std::vector<std::string> causes;
  for (const Error& error : worstErrors(evaluation, 10)) {
    causes.push_back(causeOf(evaluation, error));
  }
  std::sort(causes.begin(), causes.end());
  const std::vector<std::string> expected{"missed: occluded", "missed: unobserved_gap", "no handle of its shells",
                                          "wrong handle on door", "wrong shell on table"};
  EXPECT_EQ(causes, expected);
}

TEST(ErrorCauses, OfAnAffordanceWithoutASampleIsThat)
{
  Evaluation evaluation = withErrors();
  evaluation.frames[0].runs[0][0].ends.erase(1);
  EXPECT_EQ(causeOf(evaluation, {Error::miss, 0, 0, 0, 1, 0, 1}), "missed: no sample on it");
}

TEST(SuiteNumbers, CountAffordancesOf200Points)
{
  const Evaluation evaluation = withErrors();
  const Json numbers = numbersJson({&evaluation.frames[0]}, 0);
  EXPECT_EQ(numbers["handles"]["affordances"], 2);
  EXPECT_EQ(numbers["handles"]["none"], 2);
  EXPECT_EQ(numbers["handles"]["wrong"], 1);
  EXPECT_EQ(numbers["shells"]["found"], 1);
  EXPECT_DOUBLE_EQ(numbers["shells"]["precision"].get<double>(), 0.5);
  EXPECT_EQ(numbers["missed"]["affordances"], 2);
  EXPECT_EQ(numbers["missed"]["ends"], (Json{{"low_curvature", 5}, {"unobserved_gap", 7}, {"shells", 1}}));
  EXPECT_EQ(numbers["reliability"][9], (Json{{"from", 0.9}, {"to", 1.0}, {"right", 0}, {"wrong", 1}}));
  EXPECT_EQ(numbers["reliability"][8]["wrong"], 0);
}

TEST(SuiteTable, HasRowsOfScenesAndColumnsOfSensorsAndBackgrounds)
{
  const Evaluation evaluation = withErrors();
  Json result = numbersJson({&evaluation.frames[0]}, 0);
  result["preset"] = "localizer";
  result["samples"] = 2000;
  result["scenes"] = Json::array({"mugs"});
  SuiteCell cell;
  cell.capture_radius = 0.026;
  cell.seeds = {101, 102};
  std::vector<Json> cells;
  for (const auto& [row, background] :
       std::vector<std::pair<std::string, std::string>>{{"paper", "walls"}, {"paper", "open"}, {"far", "open"}}) {
    cell.row = row;
    cell.sensor = "xtion";
    cell.background = background;
    cells.push_back({{"cell", cellDescription(cell)}, {"results", Json::array({result})}});
  }
  const std::string tables = suiteTables(cells);
  const auto expectLine = [&](const std::string& line) {
    EXPECT_NE(tables.find("\n" + line + "\n"), std::string::npos) << line << "\nin\n" << tables;
  };
  expectLine("| | xtion, walls | xtion, open |");
  expectLine("| `paper` | **0.0** of 2, 100.0, 0.0; 1, 0.0 | **0.0** of 2, 100.0, 0.0; 1, 0.0 |");
  expectLine("| `far` | | **0.0** of 2, 100.0, 0.0; 1, 0.0 |");
  expectLine("| `far` | | 50.0, 50.0 |");
  expectLine("| `far` | xtion, open | 2 | 13 | 38 | 54 | 8 |");
  expectLine("| | | 0.9 to 1.0 |");
  expectLine("| `far` | xtion, open | 0.0 of 1 |");
  expectLine("| `far` | | 1 × 101 to 102 |");
}

class SuiteStoreTest : public TestWithFolder
{
protected:
  SuiteCell cell() const { return suiteFromYaml("grid: [{scenes: [table]}]").front(); }
  std::string folder() const { return folder_.string(); }
};

TEST_F(SuiteStoreTest, FindsWhatItSavedUntilSomethingChanges)
{
  const SuiteStore store(folder(), "");
  EXPECT_FALSE(store.find(cell()));
  store.save(cell(), Json::array({1}), 2.0);
  ASSERT_TRUE(store.find(cell()));
  EXPECT_EQ((*store.find(cell()))["results"], Json::array({1}));
  SuiteCell other = cell();
  other.seeds.push_back(7);
  EXPECT_FALSE(store.find(other)) << "other seeds";
  const std::string config = folder() + "/changed.yaml";
  std::ofstream(config) << "sampling: {samples: 100}\n";
  EXPECT_FALSE(SuiteStore(folder(), config).find(cell())) << "other parameters";
  EXPECT_TRUE(SuiteStore(folder(), "").find(cell()));
}

TEST_F(SuiteStoreTest, DoesACellAgainWhoseSensorHasChanged)
{
  SuiteCell own = cell();
  own.sensor = folder() + "/own.yaml";
  std::ofstream(own.sensor) << "{}\n";
  const SuiteStore store(folder(), "");
  store.save(own, Json::array(), 1.0);
  EXPECT_TRUE(store.find(own));
  std::ofstream(own.sensor) << "{noise: {disparity: 0.1}}\n";
  EXPECT_FALSE(store.find(own));
}

TEST_F(SuiteStoreTest, TakesADamagedResultForNone)
{
  const SuiteStore store(folder(), "");
  store.save(cell(), Json::array(), 1.0);
  for (const auto& entry : std::filesystem::directory_iterator(folder() + "/cells")) {
    std::ofstream(entry.path()) << "{\"cell\": ";
  }
  EXPECT_FALSE(store.find(cell()));
}

}  // namespace
}  // namespace grasp_affordances::test
