#include "support/given_samples.h"
#include "support/property_cases.h"

#include <gtest/gtest.h>

// A larger hand can do what a smaller one can: with the neighborhoods as they are, no shell is lost to the radius.
namespace grasp_affordances::test
{
namespace
{

// Surfaces are not continued here: they are over shadows as wide as eight capture radii, and may block a larger hand.
// Nor is the measured length compared: parts of which something hides all that the hand reaches count to it, and a
// larger hand reaches what is in front of them.
TEST(Properties, MoreCaptureRadiusLosesNoShell)
{
  Tally all;
  std::size_t gained = 0, lost_otherwise = 0;
  forEachCase([&](PropertyCase property) {
    Config& config = property.config;
    config.shell.continue_surfaces = false;
    config.neighborhood.radius = 0.026;
    config.hand.capture_radius = 0.018;
    const Frame frame = DepthCamera().capture(property.view.scene, property.view.T_scene_camera, property.seed);
    const MeasuredPoints given = samplesOf(somePoints(frame.cloud, config, property.samples, property.random));
    std::vector<SampleResult> smaller = GivenSamples(alone(frame.cloud), config).examine(given);
    for (const int steps : {1, 3, 8}) {
      // By whole steps, for a fit anew starts at a whole number of them below the capture radius.
      config.hand.capture_radius += steps * config.shell.radius_step;
      const std::vector<SampleResult> larger = GivenSamples(alone(frame.cloud), config).examine(given);
      for (std::size_t i = 0; i < given.size(); ++i) {
        const Outcome outcome = larger[i].outcome;
        if (smaller[i].outcome != Outcome::shell) {
          gained += outcome == Outcome::shell ? 1 : 0;
        } else if (outcome == Outcome::shell) {
          EXPECT_NEAR(smaller[i].shell.inner_radius, larger[i].shell.inner_radius, kRounding.place) << "sample " << i;
          EXPECT_LT(lineAngle(smaller[i].shell.axis, larger[i].shell.axis), kRounding.direction) << "sample " << i;
        } else {
          EXPECT_NE(Outcome::low_curvature, outcome) << "sample " << i;
          EXPECT_NE(Outcome::no_shell, outcome) << "sample " << i;
          ++lost_otherwise;
        }
      }
      all.add(compare(
          smaller, larger, [](const Shell& shell) { return shell; }, kRounding));
      smaller = larger;
    }
  });
  conclude("more capture radius", all);
  EXPECT_LE(lost_otherwise, all.shells / 100);  // as too short, by those parts
  EXPECT_LE(all.off, all.shells / 50);          // likewise
  EXPECT_GE(gained, propertySeeds());
}

}  // namespace
}  // namespace grasp_affordances::test
