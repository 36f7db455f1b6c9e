#include "grasp_affordances/localizer.h"

#include "io/bag.h"
#include "io/pcd.h"
#include "support/judge.h"
#include "support/recordings.h"

#include <gtest/gtest.h>
#include <pcl/PCLPointCloud2.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

struct LabelledCloud
{
  Cloud cloud;
  std::vector<std::uint32_t> labels;
};

LabelledCloud readLabelled(const std::string& path)
{
  const pcl::PCLPointCloud2 message = readPcd(path);
  LabelledCloud labelled;
  cloudFromPointCloud2(message, labelled.cloud);
  for (const auto& field : message.fields) {
    if (field.name == "label") {
      labelled.labels.resize(labelled.cloud.size());
      for (std::size_t i = 0; i < labelled.labels.size(); ++i) {
        std::memcpy(&labelled.labels[i], &message.data[i * message.point_step + field.offset], sizeof(std::uint32_t));
      }
    }
  }
  return labelled;
}

class TableTop : public testing::TestWithParam<const char*>
{
};

/// Every affordance that labels.json lists, in each of five seeds; nothing on the scenes of boxes.
TEST_P(TableTop, HasItsAffordancesFound)
{
  REQUIRE_RECORDINGS(folder);
  const auto truth = nlohmann::json::parse(std::ifstream(folder + "/mosd/labels.json"));
  const auto affordances = truth.at("scenes").at(GetParam()).at("affordances");
  std::map<std::uint32_t, std::uint32_t> affordance_of_label;
  for (const std::uint32_t label : truth.at("scenes").at(GetParam()).at("ignore")) {
    affordance_of_label[label] = kDoubtful;
  }
  for (std::size_t i = 0; i < affordances.size(); ++i) {
    for (const std::uint32_t label : affordances[i]) {
      affordance_of_label[label] = static_cast<std::uint32_t>(i + 1);
    }
  }
  LabelledCloud recorded = readLabelled(folder + "/mosd/" + GetParam() + ".pcd");
  ASSERT_FALSE(recorded.labels.empty());
  for (std::uint32_t& label : recorded.labels) {
    const auto found = affordance_of_label.find(label);
    label = found == affordance_of_label.end() ? 0 : found->second;
  }

  Config config = presetConfig("localizer");
  config.hand.capture_radius = truth.at("capture_radius");
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    config.sampling.seed = seed;
    const Localization result = Localizer(config).localize(recorded.cloud);
    std::set<std::uint32_t> found;
    for (const Shell& shell : result.shells) {
      found.insert(judge(shell, recorded.cloud, recorded.labels).affordance);
    }
    for (std::uint32_t i = 1; i <= affordances.size(); ++i) {
      EXPECT_EQ(found.count(i), 1U) << "affordance " << affordances[i - 1] << ", seed " << seed;
    }
    const std::string scene = GetParam();
    if (scene == "learn5" || scene == "learn20") {
      EXPECT_TRUE(result.shells.empty()) << "seed " << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Recordings, TableTop,
                         testing::Values("learn5", "learn20", "learn31", "learn33", "learn38", "learn39", "learn40",
                                         "learn42", "learn43", "learn44"),
                         [](const testing::TestParamInfo<const char*>& info) { return info.param; });

/// The can: radius about 3 cm, on a table.
TEST(Recordings, SodaCanInTheBagIsFound)
{
  REQUIRE_RECORDINGS(folder);
  Config config = presetConfig("localizer");
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
  };
  readBagClouds(folder + "/bags/soda_can.bag", "", visitor);
  EXPECT_EQ(clouds, 1);
}

}  // namespace
}  // namespace grasp_affordances::test
