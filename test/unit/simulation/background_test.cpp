#include "simulation/background.h"
#include "simulation/arrangement.h"
#include "simulation/ground_truth.h"
#include "simulation/placement.h"
#include "simulation/scene_library.h"
#include "simulation/sensor.h"
#include "simulation/things.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace grasp_affordances
{
namespace
{

const std::vector<Background> kOthers = {Background::open, Background::far, Background::room, Background::dark};

std::string nameOf(Background background)
{
  return backgroundNames()[static_cast<std::size_t>(background)];
}

Frame capture(const View& view, std::uint64_t seed)
{
  SensorModel model;
  model.exact = true;
  return DepthCamera(model).capture(view.scene, view.T_scene_camera, seed);
}

using PosedObject = std::pair<std::string, std::vector<Eigen::Matrix4d>>;

/// Names of the things, and the poses of their parts.
std::vector<PosedObject> things(const Scene& scene)
{
  std::vector<PosedObject> result;
  for (std::size_t object = 0; object < scene.objects().size(); ++object) {
    if (!isThing(scene.roles()[object]))
      continue;
    result.push_back({scene.objects()[object], {}});
    for (const Part& part : scene.parts()) {
      if (part.object == object)
        result.back().second.push_back(part.T_scene_shape.matrix());
    }
  }
  return result;
}

/// Ranges of the measured points that belong to objects of the background or of the floor and walls.
std::vector<double> rangesBehind(const View& view, const Frame& frame)
{
  std::vector<double> ranges;
  for (std::size_t i = 0; i < frame.cloud.size(); ++i) {
    if (frame.parts[i] < 0)
      continue;
    const Role role = view.scene.roles()[view.scene.parts()[frame.parts[i]].object];
    if (role == Role::background || role == Role::floor || role == Role::wall)
      ranges.push_back(frame.cloud.point(i).norm());
  }
  return ranges;
}

class SceneBefore : public testing::TestWithParam<std::string>
{
};

std::vector<std::string> allScenes()
{
  std::vector<std::string> names;
  for (const NamedScene& scene : sceneLibrary())
    names.push_back(scene.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Library, SceneBefore, testing::ValuesIn(allScenes()),
                         [](const auto& info) { return info.param; });

TEST_P(SceneBefore, AnotherBackgroundHasTheSameThingsCameraAndAffordances)
{
  for (const std::uint64_t seed : {1, 2}) {
    const View walls = makeScene(GetParam(), seed);
    for (const Background background : kOthers) {
      SCOPED_TRACE(nameOf(background) + ", seed " + std::to_string(seed));
      const View other = makeScene(GetParam(), seed, background);
      EXPECT_EQ(things(walls.scene), things(other.scene));
      EXPECT_EQ(walls.T_scene_camera.matrix(), other.T_scene_camera.matrix());
      EXPECT_EQ(walls.scene.chains().size(), other.scene.chains().size());
      if (sceneFamily(GetParam()) != "tests") {
        EXPECT_FALSE(capture(walls, seed).depth == capture(other, seed).depth);
      }
    }
  }
}

TEST_P(SceneBefore, AnOpenBackgroundHasNothingBehind)
{
  for (const std::uint64_t seed : {1, 2, 3}) {
    const View view = makeScene(GetParam(), seed, Background::open);
    EXPECT_TRUE(rangesBehind(view, capture(view, seed)).empty()) << "seed " << seed;
  }
}

TEST(Background, LeavesTheAffordancesOfTheTenScenes)
{
  for (const NamedScene& scene : sceneLibrary()) {
    // Where a broom leans on a wall, its upper end is free without the wall.
    if (scene.family != "paper" || scene.name == "cleaning2" || scene.name == "cleaning3")
      continue;
    const auto affordances = [&](Background background) {
      const View view = makeScene(scene.name, 3, background);
      std::vector<std::pair<std::string, double>> found;
      for (const Affordance& affordance : groundTruth(view, capture(view, 3), SensorModel()).affordances)
        found.emplace_back(affordance.object, affordance.length);
      return found;
    };
    for (const Background background : kOthers)
      EXPECT_EQ(affordances(Background::walls), affordances(background)) << scene.name << ", " << nameOf(background);
  }
}

TEST(Background, FarIsAtTheEdgeOfTheRange)
{
  std::size_t measured = 0, pixels = 0;
  for (const char* name : {"mugs", "kitchen1", "luggage", "far"}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      const View view = makeScene(name, seed, Background::far);
      const Frame frame = capture(view, seed);
      for (const double range : rangesBehind(view, frame))
        EXPECT_GT(range, 2.5) << name << ", seed " << seed;
      measured += rangesBehind(view, frame).size();
      pixels += static_cast<std::size_t>(std::count(frame.parts.begin(), frame.parts.end(), -1));
    }
  }
  EXPECT_GT(measured, 100000U) << "some of it is in range";
  EXPECT_GT(pixels, 100000U) << "and some is not";
}

TEST(Background, RoomHasFurnitureTwoToFourMetresAwayWithDoubtfulBars)
{
  std::size_t with_furniture = 0, with_doubtful_bars = 0;
  constexpr std::uint64_t kSeeds = 10;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const View view = makeScene("mugs", seed, Background::room);
    const Frame frame = capture(view, seed);
    const GroundTruth truth = groundTruth(view, frame, SensorModel());
    std::size_t furniture = 0, doubtful = 0;
    for (std::size_t i = 0; i < frame.parts.size(); ++i) {
      if (frame.parts[i] < 0)
        continue;
      const Part& part = view.scene.parts()[frame.parts[i]];
      if (view.scene.roles()[part.object] != Role::background)
        continue;
      EXPECT_TRUE(truth.labels[i] == kNotGraspable || truth.labels[i] == kDoubtful);
      if (std::holds_alternative<HalfSpace>(part.shape))
        continue;
      ++furniture;
      doubtful += truth.labels[i] == kDoubtful ? 1 : 0;
      EXPECT_GT(frame.cloud.point(i).norm(), 1.5) << "seed " << seed;
      EXPECT_LT(frame.cloud.point(i).norm(), 4.5) << "seed " << seed;
    }
    with_furniture += furniture > 2000 ? 1 : 0;
    with_doubtful_bars += doubtful > 100 ? 1 : 0;
  }
  EXPECT_GE(with_furniture, kSeeds - 2);
  EXPECT_GE(with_doubtful_bars, kSeeds / 2);
}

TEST(Background, DarkSwallowsLightBesideAndBehindAndTouchesNothing)
{
  for (const char* name : {"mugs", "luggage", "cleaning3", "clutter"}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const View view = makeScene(name, seed, Background::dark);
      const Frame frame = capture(view, seed);
      EXPECT_GT(std::count(frame.parts.begin(), frame.parts.end(), -1), 10000) << name << ", seed " << seed;
      for (const Part& part : view.scene.parts()) {
        const std::string& object = view.scene.objects()[part.object];
        if (object != "screen" && object != "dark suitcase")
          continue;
        const Eigen::Isometry3d T_part_scene = part.T_scene_shape.inverse();
        EXPECT_GT(boundsOfThings(view.scene, T_part_scene).exteriorDistance(boundingBox(part.shape)), 0.025)
            << object << ", " << name << ", seed " << seed;
      }
    }
  }
}

TEST(Background, IsKnownByItsName)
{
  for (const std::string& name : backgroundNames())
    EXPECT_EQ(nameOf(backgroundFromName(name)), name);
  EXPECT_THROW(backgroundFromName("wall"), std::invalid_argument);
}

TEST(CameraPose, TurnsTheCameraAboutWhatItLooksAt)
{
  for (const char* name : {"mugs", "luggage", "clutter"}) {
    const View own = makeScene(name, 1);
    for (const double tilt : {0.0, 30.0, 75.0}) {
      for (const double distance : {0.4, 1.5}) {
        const View view = posed(own, {kDegree * tilt, distance});
        const Eigen::Vector3d forward = view.T_scene_camera.linear().col(2);
        EXPECT_NEAR(std::asin(-forward.z()), kDegree * tilt, 1e-12);
        const Eigen::Vector3d target = view.T_scene_camera * Eigen::Vector3d(0.0, 0.0, distance);
        const Eigen::Vector3d seen = own.T_scene_camera.inverse() * target;
        EXPECT_NEAR(seen.head<2>().norm(), 0.0, 1e-9) << "the same point stays in the middle of the picture";
        EXPECT_LT((target - middleOfThings(own.scene)).norm(), 0.2);
      }
    }
    EXPECT_EQ(posed(own, {}).T_scene_camera.matrix(), own.T_scene_camera.matrix());
  }
}

TEST(CameraPose, RefusesASceneThatIsSeenAlongTheVertical)
{
  EXPECT_THROW(makeScene("shadow", 1, Background::walls, {0.5, std::nullopt}), std::invalid_argument);
}

}  // namespace
}  // namespace grasp_affordances
