#include "cli/localize_calls.h"

#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances
{
namespace
{

using namespace test;

TEST_F(LocalizeTest, refusesBadUsageAndParameters)
{
  write("table.pcd", table());
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases{
      {"", {"no cloud"}},
      {"--nonsense table.pcd", {"--nonsense"}},
      {"--samples", {"--samples"}},
      {"--samples 0 table.pcd", {"sampling/samples", "0", "[1, "}},
      {"--samples -5 table.pcd", {"sampling/samples", "-5", "[1, "}},
      {"--samples many table.pcd", {"sampling/samples", "many"}},
      {"--samples 3.5 table.pcd", {"sampling/samples", "3.5"}},
      {"--samples 99999999999 table.pcd", {"sampling/samples", "99999999999"}},
      {"--samples '' table.pcd", {"sampling/samples"}},
      {"--samples 1 --samples 2 table.pcd", {"--samples"}},
      {"--capture-radius 0 table.pcd", {"hand/capture_radius", "0", "[0.002, "}},
      {"--capture-radius nan table.pcd", {"hand/capture_radius", "nan"}},
      {"--capture-radius inf table.pcd", {"hand/capture_radius", "inf"}},
      {"--finger-thickness 5 table.pcd", {"hand/finger_thickness", "5"}},
      {"--min-length -1 table.pcd", {"shell/min_length", "-1"}},
      {"--threads -1 table.pcd", {"threads", "-1"}},
      {"--seed -1 table.pcd", {"sampling/seed"}},
      {"--neighborhood cube table.pcd", {"neighborhood/kind", "cube", "radius, knn"}},
      {"--estimator ransac table.pcd", {"estimation/estimator", "ransac", "taubin, pca, normals"}},
      {"--viewpoint table.pcd", {"--viewpoint"}},
      {"--viewpoint 1,2 table.pcd", {"--viewpoint 1,2", "x,y,z"}},
      {"--viewpoint 1,2,3,4 table.pcd", {"--viewpoint 1,2,3,4", "x,y,z"}},
      {"--viewpoint 1,2,up table.pcd", {"--viewpoint 1,2,up", "x,y,z"}},
      {"--viewpoint 1,2,nan table.pcd", {"--viewpoint 1,2,nan", "x,y,z"}},
      {"--viewpoint 1,2,1e39 table.pcd", {"--viewpoint 1,2,1e39", "x,y,z"}},
      {"--viewpoint 1,2,3 --view table.pcd", {"--viewpoint 1,2,3", "--view"}},
      {"--preset thesis table.pcd", {"preset", "thesis", "localizer, paper"}},
      {"--config missing.yaml table.pcd", {"missing.yaml"}},
      {"--config " + writeText("unknown.yaml", "hand: {reach: 1}") + " table.pcd", {"unknown.yaml", "hand/reach"}},
      {"--config " + writeText("range.yaml", "hand: {capture_radius: 7}") + " table.pcd",
       {"hand/capture_radius", "7", "0.5"}},
      {"--config " + writeText("list.yaml", "[1, 2]") + " table.pcd", {"list.yaml"}},
      {"--config " + writeText("broken.yaml", "hand: {") + " table.pcd", {"broken.yaml"}},
      {"--preset localizer --config " + writeText("paper.yaml", "preset: paper") + " table.pcd",
       {"localizer", "paper"}},
  };
  for (const auto& [arguments, words] : cases) {
    SCOPED_TRACE(arguments);
    const Call call = localize("--json " + arguments);
    EXPECT_EQ(call.status, 2);
    EXPECT_EQ(call.out, "");
    EXPECT_EQ(lines(call.err).size(), 1U) << call.err;
    for (const std::string& word : words) {
      EXPECT_NE(call.err.find(word), std::string::npos) << "'" << word << "' is missing in: " << call.err;
    }
  }
}

TEST_F(LocalizeTest, readsConfigOverPresetAndOptionsOverBoth)
{
  write("table.pcd", table());
  writeText("values.yaml", "sampling: {samples: 70, seed: 9}\nhand: {finger_thickness: 0.01}");
  writeText("paper.yaml", "preset: paper\nsampling: {samples: 80}");
  const auto call = [this](const std::string& options) {
    const Json json = localize("--json " + options + " table.pcd").json().at(0);
    return json["preset"].get<std::string>() + " " + json["counts"]["sampled"].dump() + " " + json["seed"].dump();
  };
  EXPECT_EQ(call(""), "localizer 2000 1");
  EXPECT_EQ(call("--preset paper"), "paper 4000 1");
  EXPECT_EQ(call("--config values.yaml"), "localizer 70 9");
  EXPECT_EQ(call("--config values.yaml --preset paper --seed 4"), "paper 70 4");
  EXPECT_EQ(call("--config paper.yaml"), "paper 80 1");
  EXPECT_EQ(call("--config paper.yaml --preset paper --samples 60"), "paper 60 1");
  const Json wide = localize("--json --samples 2000 --finger-thickness 0.005 --min-length 0.05 table.pcd").json().at(0);
  ASSERT_FALSE(wide["shells"].empty());
  for (const Json& shell : wide["shells"]) {
    EXPECT_EQ(shell["thickness"], 0.005);
    EXPECT_GE(shell["length"], 0.05 - 1e-9);
  }
  const Json paper = localize("--json --samples 2000 --preset paper --min-length 0.05 table.pcd").json().at(0);
  ASSERT_FALSE(paper["shells"].empty());
  for (const Json& shell : paper["shells"]) {
    EXPECT_GE(shell["length"], 0.05 - 1e-9) << "measured, since a least length is asked for";
  }
}

TEST_F(LocalizeTest, drawsPictures)
{
  write("table.pcd", table());
  write("unorganized.pcd", unorganized(table()));
  const Call call = localize("--samples 2000 --picture out.v1.png table.pcd missing.pcd unorganized.pcd");
  EXPECT_EQ(call.status, 1);
  const std::string kSignature("\x89PNG\r\n\x1a\n\0\0\0\x0DIHDR\0\0\x05\0\0\0\x03\xC0", 24);  // 1280 x 960
  EXPECT_EQ(content("out.v1.png").substr(0, 24), kSignature);
  EXPECT_EQ(content("out.v1-2.png").substr(0, 24), kSignature);
  EXPECT_FALSE(std::filesystem::exists(path("out.v1-3.png")));

  const Call unwritable = localize("--json --samples 100 --picture nowhere/out.png table.pcd");
  EXPECT_EQ(unwritable.status, 1);
  EXPECT_EQ(unwritable.json().size(), 1U) << "the result is printed all the same";
  EXPECT_NE(unwritable.err.find("nowhere/out.png: No such file"), std::string::npos) << unwritable.err;
}

TEST_F(LocalizeTest, printsATableForPeople)
{
  write("table.pcd", table());
  const Call call = localize("table.pcd");
  EXPECT_EQ(call.status, 0);
  EXPECT_EQ(call.err, "");
  ASSERT_GT(lines(call.out).size(), 2U);
  EXPECT_EQ(lines(call.out)[0].find("table.pcd: "), 0U) << call.out;
  EXPECT_LE(lines(call.out).size(), 24U) << "short, however many shells there are";
  const Json json = localize("--json table.pcd").json().at(0);
  const std::string handles = std::to_string(json["handles"].size()) + " handles";
  EXPECT_NE(lines(call.out)[0].find(handles), std::string::npos) << call.out;
  EXPECT_EQ(lines(call.out)[2].find("   1 "), 0U) << "the best handle comes first\n" << call.out;
  const std::string shells = std::to_string(json["shells"].size()) + " shells";
  EXPECT_NE(lines(call.out).back().find(shells), std::string::npos) << call.out;
}

TEST_F(LocalizeTest, printsHelpAndVersion)
{
  const Call help = localize("--help");
  EXPECT_EQ(help.status, 0);
  for (const char* option :
       {"--config", "--preset", "--samples", "--capture-radius", "--finger-thickness", "--min-length", "--neighborhood",
        "--estimator", "--threads", "--seed", "--topic", "--picture", "--json", "--viewpoint"}) {
    EXPECT_NE(help.out.find(option), std::string::npos) << option;
  }
  const Call version = localize("--version");
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out.find("localize "), 0U);
  EXPECT_TRUE(std::isdigit(version.out[9])) << version.out;
}

TEST_F(LocalizeTest, saysWhenStdoutIsFull)
{
  write("table.pcd", table());
  EXPECT_EQ(run("(" LOCALIZE " --json --samples 10 table.pcd > /dev/full)"), 1);
  EXPECT_NE(content("stderr").find("cannot write to stdout"), std::string::npos);
}

}  // namespace
}  // namespace grasp_affordances
