#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"
#include "grasp_affordances/parameters.h"

#include "core/sample_block.h"
#include "simulation/scene_library.h"

#include "support/given_samples.h"
#include "support/points.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{

/// For how many seeds each property is tested: GRASP_AFFORDANCES_PROPERTY_SEEDS, or 1.
inline std::uint64_t propertySeeds()
{
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody changes the environment
  const char* text = std::getenv("GRASP_AFFORDANCES_PROPERTY_SEEDS");
  const std::uint64_t seeds = text == nullptr ? 1 : std::strtoull(text, nullptr, 10);
  if (seeds == 0) {
    throw std::runtime_error(std::string("GRASP_AFFORDANCES_PROPERTY_SEEDS is no number of seeds: ") + text);
  }
  return seeds;
}

/// A scene, parameters, and everything else that is drawn for it.
struct PropertyCase
{
  View view;
  std::uint64_t seed;
  Config config;
  std::size_t samples;  // fewer where they take long
  Random random;
};

/// Those with objects on which something may be found.
inline std::vector<NamedScene> scenesOfObjects()
{
  std::vector<NamedScene> scenes = sceneLibrary();
  const std::vector<std::string> bare{"empty_table", "shadow", "shadow_removed"};
  scenes.erase(std::remove_if(scenes.begin(), scenes.end(),
                              [&](const NamedScene& scene) {
                                return std::find(bare.begin(), bare.end(), scene.name) != bare.end();
                              }),
               scenes.end());
  return scenes;
}

/// Calls body(property_case) for both presets with each estimator, and neighborhoods of either kind by turns, which is
/// the other one with the next seed. The scenes of the library take turns, too. Samples are given, and so are the
/// points at which curvature is taken: all of a neighborhood.
template <typename Body>
void forEachCase(Body&& body)
{
  const std::vector<NamedScene> scenes = scenesOfObjects();
  std::uint64_t number = 0;
  for (std::uint64_t seed = 1; seed <= propertySeeds(); ++seed) {
    for (const std::string& preset : presetNames()) {
      for (const Estimator estimator : {Estimator::taubin, Estimator::pca, Estimator::normals}) {
        const NamedScene& scene = scenes[number % scenes.size()];
        Config config = presetConfig(preset);
        config.sampling.screen = false;
        config.estimation.estimator = estimator;
        config.estimation.curvature_points = 10000;
        config.neighborhood.kind = (number + seed) % 2 == 1 ? NeighborhoodKind::radius : NeighborhoodKind::knn;
        SCOPED_TRACE("scene " + scene.name + ", seed " + std::to_string(seed) + ", preset " + preset + ", " +
                     enumWord(estimator) + ", " + enumWord(config.neighborhood.kind));
        const std::size_t samples = estimator == Estimator::normals ? 20 : 200;
        body(PropertyCase{scene.generate(seed), seed, config, samples, Random(++number)});
        if (testing::Test::HasFatalFailure()) {
          return;
        }
      }
    }
  }
}

/// Largest differences between shells that should be the same.
struct Differences
{
  double place = 0.0;      // m: centroid, radius, length
  double direction = 0.0;  // rad: axis; normal
  double curvature = 0.0;  // relative
  double share = 0.0;      // of observed free space
  double points = 0.0;     // inside and in the gap

  void add(const Differences& other)
  {
    place = std::max(place, other.place);
    direction = std::max(direction, other.direction);
    curvature = std::max(curvature, other.curvature);
    share = std::max(share, other.share);
    points = std::max(points, other.points);
  }
};

inline double difference(double a, double b)
{
  return std::isnan(a) && std::isnan(b) ? 0.0 : std::abs(a - b);
}

inline Differences differences(const Shell& a, const Shell& b)
{
  Differences result;
  result.place = std::max({(a.centroid - b.centroid).norm(), difference(a.inner_radius, b.inner_radius),
                           difference(a.length, b.length), difference(a.thickness, b.thickness)});
  result.direction = std::max(lineAngle(a.axis, b.axis), (a.normal - b.normal).norm());
  result.curvature = difference(a.curvature, b.curvature) / (std::isnan(a.curvature) ? 1.0 : a.curvature);
  result.share = difference(a.observed_free, b.observed_free);
  result.points = std::max(difference(a.points_inside, b.points_inside), difference(a.points_in_gap, b.points_in_gap));
  return result;
}

/// Tolerances of shells that differ by rounding.
struct Tolerance
{
  double place;      // m
  double direction;  // rad
  double curvature;  // relative
};

/// What rounding in double precision may do: coordinates of up to 2 m have 15 digits, and the fits of quadrics, circles
/// and axes cost some of them, the more the nearer a neighborhood is to one that has no axis (it is refused with a
/// relative gap between eigenvalues of 1e-3).
constexpr Tolerance kRounding{1e-9, 1e-9, 1e-9};

/// How the samples of two localizations compare. Of none of these may there be more than a test says.
struct Tally
{
  std::size_t samples = 0, shells = 0;  // in both
  std::size_t flipped = 0;              // ended differently
  std::size_t off = 0;                  // shells that differ by more than a tolerance
  Differences largest;                  // of those that do not

  void add(const Tally& other)
  {
    samples += other.samples;
    shells += other.shells;
    flipped += other.flipped;
    off += other.off;
    largest.add(other.largest);
  }
};

/// @param change  what becomes of a shell
template <typename Change>
Tally compare(const std::vector<SampleResult>& expected, const std::vector<SampleResult>& actual, Change&& change,
              const Tolerance& tolerance)
{
  Tally tally;
  tally.samples = expected.size();
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i].outcome != actual[i].outcome) {
      ++tally.flipped;
    } else if (expected[i].outcome == Outcome::shell) {
      ++tally.shells;
      const Differences found = differences(change(expected[i].shell), actual[i].shell);
      const bool off = found.place > tolerance.place || found.direction > tolerance.direction ||
                       found.curvature > tolerance.curvature || found.points > 0.0 || found.share > 0.0;
      if (off) {
        ++tally.off;
      } else {
        tally.largest.add(found);
      }
    }
  }
  return tally;
}

/// Says how much of the tolerance was needed, and fails where shells were so few that nothing was shown.
inline void conclude(const std::string& property, const Tally& tally)
{
  std::printf("%s: %zu samples, %zu shells; %zu flipped, %zu off; others within %.2g m, %.2g rad, %.2g of curvature\n",
              property.c_str(), tally.samples, tally.shells, tally.flipped, tally.off, tally.largest.place,
              tally.largest.direction, tally.largest.curvature);
  EXPECT_GE(tally.shells, 20 * propertySeeds());
}

/// The points of a range image that were measured, as a cloud that is not organized. @param from  their indices in the
/// image
inline Cloud measuredPointsOf(const Cloud& cloud, std::vector<std::uint32_t>& from)
{
  from.clear();
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (cloud.measured(i)) {
      from.push_back(i);
    }
  }
  Cloud result;
  result.sensor_origin = Eigen::Vector3f::Zero();
  result.reset(static_cast<std::uint32_t>(from.size()), 1);
  for (std::size_t i = 0; i < from.size(); ++i) {
    result.set(i, cloud.x[from[i]], cloud.y[from[i]], cloud.z[from[i]]);
  }
  return result;
}

/// The places in `from`, which ascends, of indices that are in it.
inline std::vector<std::uint32_t> placesIn(const std::vector<std::uint32_t>& from,
                                           const std::vector<std::uint32_t>& indices)
{
  std::vector<std::uint32_t> places;
  for (const std::uint32_t index : indices) {
    places.push_back(static_cast<std::uint32_t>(std::lower_bound(from.begin(), from.end(), index) - from.begin()));
  }
  return places;
}

}  // namespace grasp_affordances::test
