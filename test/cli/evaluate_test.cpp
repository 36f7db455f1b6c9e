#include "cli/command_line_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
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
  std::ofstream(path("paper.yaml")) << "preset: paper\n";
  expectFailure("--config paper.yaml --presets localizer", 2, "contradicts");
}

TEST_F(EvaluateTest, UnreadableLabelsAndUnwritableFolderAreFailures)
{
  expectFailure("--labels absent.json", 1, "absent.json");
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

}  // namespace
}  // namespace grasp_affordances
