#include "grasp_affordances/parameters.h"
#include "support/given_samples.h"
#include "support/property_cases.h"
#include "support/shells.h"

#include <gtest/gtest.h>

// A world twice as large, with a hand twice as large and parameters to match, has shells twice as large.
namespace grasp_affordances::test
{
namespace
{

/// Multiplies every length. What is not one, but depends on one, is the error of depth at 1 m that grows with its
/// square.
struct Scaling
{
  double factor;

  void operator()(const char* parameter, double& value, const Range<double>&, const char* unit_text, const char*) const
  {
    const std::string name = parameter, unit = unit_text;
    const bool unlimited = name.rfind("workspace/", 0) == 0 && std::abs(value) == WorkspaceConfig::kNoLimit;
    if (name == "shell/depth_error") {
      value /= factor;
    } else if (unit == "m" && !unlimited) {
      value *= factor;
    }
  }

  template <typename Number>
  void operator()(const char*, Number&, const Range<Number>&, const char*, const char*) const
  {
  }

  template <typename Word>
  void operator()(const char*, Word&, const char*) const
  {
  }
};

Config scaled(Config config, double factor)
{
  visitParameters(config, Scaling{factor});
  validate(config);
  return config;
}

Cloud scaled(Cloud cloud, double factor)
{
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto scale = static_cast<float>(factor);
    cloud.set(i, scale * cloud.x[i], scale * cloud.y[i], scale * cloud.z[i]);
  }
  return cloud;
}

Shell scaled(Shell shell, double factor)
{
  shell.centroid *= factor;
  shell.inner_radius *= factor;
  shell.thickness *= factor;
  shell.length *= factor;
  shell.curvature /= factor;
  return shell;
}

/// What becomes of a cloud's shells where its world grows.
struct Growth
{
  std::vector<SampleResult> expected, actual;
  double factor;

  Growth(const Cloud& cloud, const Config& config, const MeasuredPoints& given, double by) : factor(by)
  {
    const Cloud larger = scaled(cloud, factor);
    expected = GivenSamples(alone(cloud), config).examine(given);
    actual = GivenSamples(alone(larger), scaled(config, factor)).examine(given);
  }

  Tally tally(const Tolerance& tolerance) const
  {
    return compare(
        expected, actual, [&](const Shell& shell) { return scaled(shell, factor); }, tolerance);
  }
};

// By a power of two, which single and double precision know how to multiply with. Surfaces are not continued here:
// which ends of them are on one line is judged by an error of inverse depth, two disparity steps of the Xtion, which is
// not among the parameters. Nor are handles compared, which are fitted with the noise of an Xtion in mind.
TEST(Properties, AScaledWorldHasScaledShells)
{
  Tally organized, unordered;
  forEachCase([&](PropertyCase property) {
    Config& config = property.config;
    config.shell.continue_surfaces = false;
    const double factor = property.seed % 2 == 0 ? 0.5 : 2.0;
    const Frame frame = DepthCamera().capture(property.view.scene, property.view.T_scene_camera, property.seed);
    const std::vector<std::uint32_t> points = somePoints(frame.cloud, config, property.samples, property.random);
    const Growth growth(frame.cloud, config, samplesOf(points), factor);
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_EQ(growth.expected[i].outcome, growth.actual[i].outcome) << "sample " << i;
      // How far points are gathered for a fit anew is a fixed length, and with it the order in which they are summed.
      if (growth.expected[i].outcome == Outcome::shell && !config.shell.recenter) {
        EXPECT_TRUE(same(scaled(growth.expected[i].shell, factor), growth.actual[i].shell)) << "sample " << i;
      }
    }
    organized.add(growth.tally(kRounding));

    std::vector<std::uint32_t> from;
    const Cloud cloud = measuredPointsOf(frame.cloud, from);
    // A length that is measured goes on by 1 um beyond the last points, at either end, where their spacing is not
    // known.
    Tolerance tolerance = kRounding;
    tolerance.place += 2e-6;
    unordered.add(Growth(cloud, config, samplesOf(placesIn(from, points)), factor).tally(tolerance));
  });
  conclude("scaled", organized);
  EXPECT_EQ(0U, organized.off);
  conclude("scaled, not organized", unordered);
  EXPECT_EQ(0U, unordered.flipped);
  EXPECT_EQ(0U, unordered.off);
}

}  // namespace
}  // namespace grasp_affordances::test
