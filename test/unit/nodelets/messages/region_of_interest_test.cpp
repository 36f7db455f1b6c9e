#include "nodelets/messages/region_of_interest.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace grasp_affordances
{
namespace
{

RegionOfInterest box(double min, double max)
{
  RegionOfInterest region;
  region.frame_id = "table";
  region.min.x = region.min.y = region.min.z = min;
  region.max.x = region.max.y = region.max.z = max;
  return region;
}

std::string refusal(const RegionOfInterest& region)
{
  try {
    withRegion(Config(), region);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "";
}

TEST(RegionOfInterest, TakesThePlaceOfTheWorkspaceAndItsFrame)
{
  Config config;
  config.workspace.max_z = 3.0;
  config.sampling.samples = 17;
  const Config result = withRegion(config, box(-0.5, 0.25));
  EXPECT_EQ(result.workspace.min_x, -0.5);
  EXPECT_EQ(result.workspace.min_y, -0.5);
  EXPECT_EQ(result.workspace.min_z, -0.5);
  EXPECT_EQ(result.workspace.max_x, 0.25);
  EXPECT_EQ(result.workspace.max_y, 0.25);
  EXPECT_EQ(result.workspace.max_z, 0.25);
  EXPECT_EQ(result.sampling.samples, 17);
  EXPECT_EQ(regionFrame(box(-0.5, 0.25), "base"), "table");
}

TEST(RegionOfInterest, LeftEmptyChangesNothing)
{
  Config config;
  config.workspace.max_z = 3.0;
  EXPECT_EQ(withRegion(config, RegionOfInterest()).workspace.max_z, 3.0);
  EXPECT_FALSE(hasRegion(RegionOfInterest()));
  EXPECT_EQ(regionFrame(RegionOfInterest(), "base"), "base");
  EXPECT_EQ(regionFrame(box(0.0, 0.0), "base"), "base");
}

TEST(RegionOfInterest, IsRefusedWithoutExtentOrBeyondTheRange)
{
  EXPECT_EQ(refusal(box(-0.5, 0.5)), "");
  EXPECT_NE(refusal(box(0.5, 0.5)).find("region"), std::string::npos);
  EXPECT_NE(refusal(box(0.5, -0.5)).find("not above"), std::string::npos);
  EXPECT_NE(refusal(box(-1000.0, 0.5)).find("[-100, 100] m"), std::string::npos);
  EXPECT_NE(refusal(box(std::numeric_limits<double>::quiet_NaN(), 0.5)).find("nan"), std::string::npos);
}

}  // namespace
}  // namespace grasp_affordances
