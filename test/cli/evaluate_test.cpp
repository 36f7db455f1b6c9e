#include "cli/command_line_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

namespace grasp_affordances
{
namespace
{

/// How a call of `evaluate` ended.
struct Call
{
  int status;
  std::string out, err;
};

class EvaluateTest : public test::CommandLineTest
{
protected:
  Call evaluate(const std::string& arguments) const
  {
    const int status = run("exec " EVALUATE " " + arguments);
    return {status, content("stdout"), content("stderr")};
  }

  void expectFailure(const std::string& arguments, int status, const std::string& reason) const
  {
    const Call call = evaluate(arguments);
    EXPECT_EQ(call.status, status) << arguments;
    EXPECT_NE(call.err.find(reason), std::string::npos) << arguments << ": " << call.err;
    EXPECT_EQ(std::count(call.err.begin(), call.err.end(), '\n'), 1) << arguments << ": " << call.err;
    EXPECT_EQ(call.out, "") << arguments;
  }
};

TEST_F(EvaluateTest, UsageThatMakesNoSenseIsRefused)
{
  expectFailure("--scenes attic", 2, "unknown scene 'attic'");
  expectFailure("--seeds 5:1", 2, "'5:1'");
  expectFailure("--seeds one", 2, "'one'");
  expectFailure("--seeds 1:3,2", 2, "twice");
  expectFailure("--presets best", 2, "'best'");
  expectFailure("--estimators taubing", 2, "'taubing'");
  expectFailure("--runs 0", 2, "--runs");
  expectFailure("--capture-radius -1", 2, "hand/capture_radius");
  expectFailure("--config absent.yaml", 2, "absent.yaml");
  expectFailure("--turn 0,200", 2, "--turn");
  expectFailure("--turn 0,nan", 2, "--turn");
  expectFailure("--turn 90,0,90", 2, "twice");
  expectFailure("--turn 0,90 --labels labels.json", 2, "--turn");
  expectFailure("--samples 100,200,100", 2, "twice");
  expectFailure("--samples 100,0", 2, "sampling/samples");
  expectFailure("--importance maybe", 2, "'maybe'");
  expectFailure("--frobnicate", 2, "--frobnicate");
  expectFailure("--sensor eye", 2, "'eye'");
  expectFailure("--sensor absent.yaml", 2, "absent.yaml");
  expectFailure("--background sea", 2, "'sea'");
  expectFailure("--suite best", 2, "'best'");
  expectFailure("--suite absent.yaml", 2, "absent.yaml");
  expectFailure("--suite quick --seeds 1", 2, "--seeds");
  std::ofstream(path("paper.yaml")) << "preset: paper\n";
  expectFailure("--config paper.yaml --presets localizer", 2, "contradicts");
}

TEST_F(EvaluateTest, UnreadableLabelsAndUnwritableFolderAreFailures)
{
  expectFailure("--labels absent.json", 1, "absent.json");
  expectFailure("--suite quick --labels absent.json", 1, "absent.json");
  std::ofstream(path("file")) << "not a folder";
  expectFailure("--scenes empty_table --seeds 1 --out file/below", 1, "file/below");
}

TEST_F(EvaluateTest, SaysWhenStdoutIsFull)
{
  EXPECT_EQ(run("(" EVALUATE " --scenes empty_table --seeds 1 --estimators pca --samples 100 > /dev/full)"), 1);
  EXPECT_NE(content("stderr").find("cannot write to stdout"), std::string::npos);
}

TEST_F(EvaluateTest, WritesTheSameTablesWithAnyNumberOfThreads)
{
  const std::string options = "--scenes table,empty_table --seeds 1,3 --estimators taubin --samples 1000 --runs 2 ";
  const Call one = evaluate(options + "--out one --threads 1");
  const Call three = evaluate(options + "--out three --threads 3");
  ASSERT_EQ(one.status, 0) << one.err;
  EXPECT_NE(one.out.find("| table | 2 × 2 |"), std::string::npos) << one.out;
  EXPECT_EQ(one.out, three.out);
  for (const std::string name :
       {"shells.csv", "handles.csv", "affordances.csv", "summary.csv", "summary.json", "table.md"}) {
    EXPECT_GT(content("one/" + name).size(), 100U) << name;
    EXPECT_EQ(content("one/" + name), content("three/" + name)) << name;
  }
}

TEST_F(EvaluateTest, TurnedCamerasAreViewsOfOneEvaluation)
{
  const Call call =
      evaluate("--scenes mugs --seeds 101 --presets localizer --estimators taubin --turn 75,0 --pictures 1 --out .");
  ASSERT_EQ(call.status, 0) << call.err;
  EXPECT_NE(call.out.find("2000 samples. Precision"), std::string::npos) << call.out;
  EXPECT_NE(call.out.find("2000 samples, 2 views. Precision"), std::string::npos) << call.out;
  EXPECT_NE(call.out.find(" recall: < 60, elsewhere ≥ 200 |"), std::string::npos) << call.out;
  const std::string summary = content("summary.csv");
  EXPECT_NE(summary.find("\nmugs,0,localizer,taubin,1,1,1,"), std::string::npos) << summary;
  EXPECT_NE(summary.find("\nmugs,0,localizer,taubin,2,1,1,"), std::string::npos) << summary;
}

TEST_F(EvaluateTest, SamplingIsVariedInOneCall)
{
  const std::string options = "--scenes table --seeds 1 --presets localizer --estimators taubin --pictures 0 --out . ";
  const Call call = evaluate(options + "--samples 500,1000 --importance on,off");
  ASSERT_EQ(call.status, 0) << call.err;
  EXPECT_NE(call.out.find("Preset `localizer`, taubin, 500 samples, importance sampling on. Precision"),
            std::string::npos)
      << call.out;
  EXPECT_NE(call.out.find("| table | localizer | taubin | 1 | 1000 | off |"), std::string::npos) << call.out;
  const std::string samples = content("samples.csv");
  EXPECT_EQ(std::count(samples.begin(), samples.end(), '\n'), 1 + 4) << samples;
  ASSERT_EQ(evaluate(options).status, 0);
  EXPECT_FALSE(std::filesystem::exists(path("samples.csv"))) << "of an earlier call";
}

TEST_F(EvaluateTest, SensorAndBackgroundAreThoseOfTheScenes)
{
  const std::string options = "--scenes table --seeds 1 --presets localizer --estimators taubin --pictures 0 --out . ";
  const auto shells = [&](const std::string& more) {
    const Call call = evaluate(options + more);
    EXPECT_EQ(call.status, 0) << call.err;
    return content("shells.csv");
  };
  const std::string plain = shells("");
  EXPECT_EQ(plain, shells("--sensor xtion --background walls"));
  EXPECT_NE(plain, shells("--sensor kinect_v2"));
  EXPECT_NE(plain, shells("--background open"));
}

class EvaluateSuiteTest : public EvaluateTest
{
protected:
  void SetUp() override { write("table"); }

  void write(const std::string& scenes) const
  {
    std::ofstream(path("suite.yaml")) << "seeds: 1\npictures: 1\ngrid:\n  - {scenes: [" + scenes +
                                             "], sensors: [xtion, kinect_v2], backgrounds: [open]}\n";
  }

  /// When each cell was evaluated, by its file's name.
  std::map<std::string, std::filesystem::file_time_type> cells() const
  {
    std::map<std::string, std::filesystem::file_time_type> times;
    for (const auto& entry : std::filesystem::directory_iterator(path("out/cells"))) {
      times[entry.path().filename()] = std::filesystem::last_write_time(entry.path());
    }
    return times;
  }
};

TEST_F(EvaluateSuiteTest, GoesOnWhereItEnded)
{
  const Call first = evaluate("--suite suite.yaml --out out");
  ASSERT_EQ(first.status, 0) << first.err;
  const auto finished = cells();
  ASSERT_EQ(finished.size(), 2U);
  EXPECT_EQ(evaluate("--suite suite.yaml --out out").out, first.out);
  EXPECT_EQ(cells(), finished) << "nothing was done again";
  write("table, empty_table");
  const Call more = evaluate("--suite suite.yaml --out out");
  EXPECT_NE(more.out.find("| `empty_table` |"), std::string::npos) << more.out;
  auto added = cells();
  EXPECT_EQ(added.size(), 4U);
  for (const auto& [name, time] : finished) {
    EXPECT_EQ(added[name], time) << name;
  }
  std::filesystem::remove(path("out/cells/" + finished.begin()->first));
  EXPECT_EQ(evaluate("--suite suite.yaml --out out").out, more.out);
  EXPECT_EQ(cells().size(), 4U);
}

TEST_F(EvaluateSuiteTest, HasTheSameTablesAndPicturesWithAnyNumberOfThreads)
{
  const Call one = evaluate("--suite suite.yaml --out one --threads 1");
  const Call three = evaluate("--suite suite.yaml --out three --threads 3");
  ASSERT_EQ(one.status, 0) << one.err;
  EXPECT_EQ(one.out, three.out);
  EXPECT_EQ(content("one/table.md"), one.out);
  EXPECT_EQ(run("diff -r one/pictures three/pictures"), 0) << content("stdout");
}

TEST_F(EvaluateSuiteTest, RecordedCloudsAreRowsInTheColumnOfTheirSensor)
{
  // A cloud of one point, on which nothing is found.
  std::ofstream(path("one.pcd")) << "VERSION 0.7\nFIELDS x y z label\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\n"
                                    "WIDTH 1\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1\nDATA ascii\n0 0 1 7\n";
  for (const char* const set : {"a", "b"}) {
    std::ofstream(path(std::string(set) + ".json"))
        << R"({"capture_radius": 0.026, "scenes": {"one": {"affordances": [[7]], "ignore": []}}})";
  }
  const Call call = evaluate("--suite suite.yaml --labels a.json,b.json --sensor kinect_v1 --out out");
  ASSERT_EQ(call.status, 0) << call.err;
  EXPECT_NE(call.out.find("| | xtion, open | kinect_v2, open | kinect_v1, recorded |"), std::string::npos) << call.out;
  const std::string folder = path("").substr(0, path("").size() - 1);
  for (const char* const set : {".a", ".b"}) {
    const std::string row = "| `" + std::filesystem::path(folder).filename().string() + set + "` | | | ";
    EXPECT_NE(call.out.find(row), std::string::npos) << row << "\n" << call.out;
  }
  const Call plain = evaluate("--labels a.json,b.json --estimators taubin --presets localizer --out plain");
  ASSERT_EQ(plain.status, 0) << plain.err;
  EXPECT_NE(plain.out.find(".a.one | 1 × 1 |"), std::string::npos) << plain.out;
  EXPECT_NE(plain.out.find(".b.one | 1 × 1 |"), std::string::npos) << plain.out;
}

}  // namespace
}  // namespace grasp_affordances
