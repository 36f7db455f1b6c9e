#include "simulation/scene_library.h"
#include "simulation/arrangement.h"
#include "simulation/ground_truth.h"
#include "simulation/sensor.h"
#include "support/scenes.h"

#include <gtest/gtest.h>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace grasp_affordances
{
namespace
{

TEST(SceneLibrary, SeedDeterminesTheScene)
{
  SensorModel model;
  model.exact = true;
  for (const NamedScene& scene : sceneLibrary()) {
    const auto depth = [&](std::uint64_t seed) {
      const View view = makeScene(scene.name, seed);
      return DepthCamera(model).capture(view.scene, view.T_scene_camera, 1).depth;
    };
    EXPECT_TRUE(depth(1) == depth(1)) << scene.name;
    EXPECT_FALSE(depth(1) == depth(2)) << scene.name;
  }
}

TEST(SceneLibrary, RefusesAnUnknownName)
{
  EXPECT_THROW(makeScene("tables", 1), std::invalid_argument);
}

TEST(SceneLibrary, EveryAffordanceOfTheTableIsWellVisible)
{
  for (std::uint64_t seed = 0; seed <= 20; ++seed) {
    const View view = makeScene("table", seed);
    const Frame frame = DepthCamera().capture(view.scene, view.T_scene_camera, seed);
    const GroundTruth truth = groundTruth(view, frame, SensorModel());
    ASSERT_EQ(truth.affordances.size(), 3u) << "seed " << seed;
    for (const Affordance& affordance : truth.affordances) {
      EXPECT_GE(affordance.visible_points, 700u) << affordance.object << ", seed " << seed;
      // Little of it is hidden, and that by its own object: the far end of the bar by the post.
      EXPECT_LT(affordance.occluded_share, 0.15) << affordance.object << ", seed " << seed;
    }
  }
}

TEST(SceneLibrary, StripBetweenThePlatesIsTheSameWithoutThem)
{
  SensorModel model;
  model.exact = true;  // the strip is in the projector's shadow
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const test::LabelledFrame with = test::captureScene("shadow", seed, model);
    const test::LabelledFrame without = test::captureScene("shadow_removed", seed, model);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    int n = 0;
    for (std::size_t i = 0; i < with.cloud.size(); ++i) {
      ASSERT_EQ(with.labels[i], 0u);
      ASSERT_TRUE(with.cloud.measured(i));
      if (!without.cloud.measured(i)) {
        ASSERT_NEAR(with.cloud.z[i], 0.605, 0.009);  // the plates are 1 cm thick
        continue;
      }
      ASSERT_EQ(with.cloud.point(i), without.cloud.point(i));
      ASSERT_NEAR(with.cloud.z[i], 1.2, 0.02);
      const Eigen::Vector3d p = with.cloud.point(i).cast<double>() * (1.2 / with.cloud.z[i]);
      sum += p;
      squares += p * p.transpose();
      ++n;
    }
    // A strip of even width has the variance width^2 / 12 across.
    ASSERT_GT(n, 1000);
    const Eigen::Matrix2d covariance = (squares / n - sum / n * (sum / n).transpose()).topLeftCorner<2, 2>();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
    solver.computeDirect(covariance, Eigen::EigenvaluesOnly);
    const double width = std::sqrt(12.0 * solver.eigenvalues()[0]);
    EXPECT_GT(width, 0.01);
    EXPECT_LT(width, 0.02);
  }
}

constexpr std::uint64_t kSeeds = 20;

/// What carries the other objects.
bool isSupport(const std::string& name)
{
  static const std::set<std::string> supports = {"table", "floor", "wall"};
  return supports.count(name) != 0;
}

GroundTruth truthOf(const View& view, std::uint64_t seed, const GraspDefinition& definition = GraspDefinition())
{
  return groundTruth(view, DepthCamera().capture(view.scene, view.T_scene_camera, seed), SensorModel(), definition);
}

std::multiset<std::string> affordanceObjects(const GroundTruth& truth)
{
  std::multiset<std::string> names;
  for (const Affordance& affordance : truth.affordances)
    names.insert(affordance.object);
  return names;
}

std::multiset<std::string> placedObjects(const View& view)
{
  std::multiset<std::string> names(view.scene.objects().begin(), view.scene.objects().end());
  for (const char* support : {"table", "floor", "wall"})
    names.erase(support);
  return names;
}

const std::map<std::string, std::multiset<std::string>>& objectsOfThePapersScenes()
{
  static const std::map<std::string, std::multiset<std::string>> objects = {
      {"mugs", {"mug", "mug", "mug", "mug", "mug"}},
      {"cleaning1", {"dust pan", "brush", "spray bottle", "sponge"}},
      {"kitchen1", {"French press", "lotion bottle", "long box", "mug", "salad dressing bottle"}},
      {"cleaning2", {"apple", "block", "banana", "spray bottle", "dust pan", "jug", "broom"}},
      {"household1", {"lamp", "hammer", "hair brush", "flashlight", "book", "tape"}},
      {"household2", {"cordless phone", "flashlight", "hair brush", "mug", "cup", "book"}},
      {"kitchen2", {"tea kettle", "pot", "salad dressing bottle", "salad dressing bottle", "salad dressing bottle"}},
      {"kitchen3", {"pan", "ladle", "bowl", "rolling pin", "mug", "plate"}},
      {"luggage", {"suitcase", "lying suitcase", "backpack"}},
      {"cleaning3", {"broom", "bucket", "jug", "spray bottle", "sponge"}},
  };
  return objects;
}

/// Whether an object of a scene has points inside another one.
bool reachesInto(const Scene& scene, std::size_t object, std::size_t other)
{
  const std::vector<Eigen::Vector3d> points = pointsInside(scene, object);
  return std::any_of(scene.parts().begin(), scene.parts().end(), [&](const Part& part) {
    const Eigen::Isometry3d T_shape_scene = part.T_scene_shape.inverse();
    return part.object == other && std::any_of(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
             return contains(part.shape, T_shape_scene * point);
           });
  });
}

/// Whether two objects of a scene go through each other; contact does not count. As far as pointsInside() shows it.
bool interpenetrate(const Scene& scene, std::size_t object_a, std::size_t object_b)
{
  return reachesInto(scene, object_a, object_b) || reachesInto(scene, object_b, object_a);
}

/// Every scene that is made of arranged objects.
class ArrangedScene : public testing::TestWithParam<const char*>
{
};

INSTANTIATE_TEST_SUITE_P(Library, ArrangedScene,
                         testing::Values("mugs", "cleaning1", "kitchen1", "cleaning2", "household1", "household2",
                                         "kitchen2", "kitchen3", "luggage", "cleaning3", "far", "clutter",
                                         "distractors", "tools1", "tools2", "supermarket1", "supermarket2", "desk1",
                                         "desk2"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(ArrangedScene, NoObjectGoesThroughAnother)
{
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scene scene = makeScene(GetParam(), seed).scene;
    const std::vector<std::string>& names = scene.objects();
    for (std::size_t a = 0; a < names.size(); ++a) {
      for (std::size_t b = a + 1; b < names.size(); ++b)
        EXPECT_FALSE(interpenetrate(scene, a, b)) << names[a] << " and " << names[b] << ", seed " << seed;
    }
  }
}

TEST_P(ArrangedScene, ObjectsAreInThePicture)
{
  const SensorModel model;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const View view = makeScene(GetParam(), seed);
    for (std::size_t object = 0; object < view.scene.objects().size(); ++object) {
      if (isSupport(view.scene.objects()[object]))
        continue;
      const std::vector<Eigen::Vector3d> points = pointsInside(view.scene, object);
      const auto shown = std::count_if(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
        const Eigen::Vector3d p = view.T_scene_camera.inverse() * point;
        return p.z() > model.min_depth && std::abs(p.x() / p.z()) < 0.5 * model.width / model.intrinsics.fx &&
               std::abs(p.y() / p.z()) < 0.5 * model.height / model.intrinsics.fy;
      });
      EXPECT_GT(shown, 0.85 * static_cast<double>(points.size())) << view.scene.objects()[object] << ", seed " << seed;
    }
  }
}

TEST(PapersScenes, HoldTheirObjectsAndThreeToNineAffordances)
{
  for (const auto& [name, objects] : objectsOfThePapersScenes()) {
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const View view = makeScene(name, seed);
      EXPECT_EQ(placedObjects(view), objects) << name << ", seed " << seed;
      const GroundTruth truth = truthOf(view, seed);
      EXPECT_LE(truth.affordances.size(), 9u) << name << ", seed " << seed;
      const auto visible = std::count_if(truth.affordances.begin(), truth.affordances.end(),
                                         [](const Affordance& affordance) { return affordance.visible_points >= 60; });
      EXPECT_GE(visible, 3) << name << ", seed " << seed;
    }
  }
}

TEST(PapersScenes, FrontExampleHasSevenAffordancesForItsHand)
{
  GraspDefinition definition;
  definition.capture_radius = 0.029;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const GroundTruth truth = truthOf(makeScene("cleaning2", seed), seed, definition);
    EXPECT_EQ(affordanceObjects(truth),
              (std::multiset<std::string>{"apple", "banana", "spray bottle", "dust pan", "jug", "jug", "broom"}))
        << "seed " << seed;
    for (const Affordance& affordance : truth.affordances)
      EXPECT_GE(affordance.visible_points, 100u) << affordance.object << ", seed " << seed;
  }
}

TEST(Families, FarObjectsAreFarAndHaveHandles)
{
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const View view = makeScene("far", seed);
    for (std::size_t object = 0; object < view.scene.objects().size(); ++object) {
      if (isSupport(view.scene.objects()[object]))
        continue;
      Eigen::AlignedBox3d bounds;
      for (const Eigen::Vector3d& point : pointsInside(view.scene, object))
        bounds.extend(point);
      const double distance = (bounds.center() - view.T_scene_camera.translation()).norm();
      EXPECT_GE(distance, 1.2) << view.scene.objects()[object] << ", seed " << seed;
      EXPECT_LE(distance, 1.5) << view.scene.objects()[object] << ", seed " << seed;
    }
    const GroundTruth truth = truthOf(view, seed);
    const auto visible = std::count_if(truth.affordances.begin(), truth.affordances.end(),
                                       [](const Affordance& affordance) { return affordance.visible_points >= 100; });
    EXPECT_GE(visible, 3) << "seed " << seed;
  }
}

TEST(Families, ClutterIsDense)
{
  double occluded = 0.0;
  std::size_t affordances = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const View view = makeScene("clutter", seed);
    EXPECT_GE(placedObjects(view).size(), 25u) << "seed " << seed;
    const GroundTruth truth = truthOf(view, seed);
    EXPECT_GE(truth.affordances.size(), 3u) << "seed " << seed;
    for (const Affordance& affordance : truth.affordances)
      occluded += affordance.occluded_share;
    affordances += truth.affordances.size();
  }
  EXPECT_GT(occluded / static_cast<double>(affordances), 0.2);
}

TEST(Families, DistractorsCannotBeGrasped)
{
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const View view = makeScene("distractors", seed);
    EXPECT_GE(placedObjects(view).size(), 5u) << "seed " << seed;
    const GroundTruth truth = truthOf(view, seed);
    EXPECT_EQ(affordanceObjects(truth), std::multiset<std::string>()) << "seed " << seed;
    EXPECT_EQ(std::count(truth.labels.begin(), truth.labels.end(), kDoubtful), 0) << "seed " << seed;
  }
}

TEST(Families, ArePooledByName)
{
  EXPECT_EQ(sceneFamily("kitchen1"), "paper");
  EXPECT_EQ(sceneFamily("clutter"), "clutter");
  EXPECT_EQ(sceneFamily("doors2"), "doors");
  EXPECT_THROW(sceneFamily("doors"), std::invalid_argument);
}

/// Affordances with at least 60 points in all seeds of a family's scenes, by the name of the object.
std::map<std::string, int> visibleAffordances(const std::string& family, const GraspDefinition& definition)
{
  std::map<std::string, int> found;
  for (const NamedScene& scene : sceneLibrary()) {
    if (scene.family != family)
      continue;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      for (const Affordance& affordance : truthOf(makeScene(scene.name, seed), seed, definition).affordances)
        found[affordance.object] += affordance.visible_points >= 60 ? 1 : 0;
    }
  }
  return found;
}

TEST(Families, DoorsHaveHandlesOfEveryKind)
{
  const std::map<std::string, int> found = visibleAffordances("doors", GraspDefinition());
  for (const char* handle : {"bar handle", "bow handle", "staple handle", "knob", "lever", "appliance handle"})
    EXPECT_GE(found.count(handle) > 0 ? found.at(handle) : 0, 5) << handle;
  EXPECT_EQ(found.count("control knob"), 0U) << "too short";
}

TEST(Families, DoorsHaveOneAffordanceAHandleAndBarsWithoutRoomForAFinger)
{
  int close_bars = 0;
  for (const char* name : {"doors1", "doors2", "doors3"}) {
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const View view = makeScene(name, seed);
      const GroundTruth truth = truthOf(view, seed);
      const std::multiset<std::string> placed = placedObjects(view);
      const std::multiset<std::string> graspable = affordanceObjects(truth);
      for (const std::string& handle : std::set<std::string>(graspable.begin(), graspable.end()))
        EXPECT_LE(graspable.count(handle), placed.count(handle)) << handle << ", " << name << ", seed " << seed;
      close_bars += static_cast<int>(placed.count("bar handle")) - static_cast<int>(graspable.count("bar handle"));
    }
  }
  EXPECT_GE(close_bars, 5);
}

TEST(Families, ToolsAreHeldByTheirGrips)
{
  const std::map<std::string, int> found = visibleAffordances("tools", GraspDefinition());
  for (const char* tool : {"drill", "pliers", "claw hammer", "screwdriver", "iron", "hair dryer", "watering can"})
    EXPECT_GE(found.count(tool) > 0 ? found.at(tool) : 0, 6) << tool;
}

TEST(Families, GroceriesAreForLargeHands)
{
  GraspDefinition large;
  large.capture_radius = 0.045;
  const std::map<std::string, int> found = visibleAffordances("supermarket", large);
  for (const char* product : {"tin", "drink bottle", "carton", "package", "orange", "apple", "lemon"})
    EXPECT_GE(found.count(product) > 0 ? found.at(product) : 0, 3) << product;
  const std::map<std::string, int> small = visibleAffordances("supermarket", GraspDefinition());
  EXPECT_EQ(small.count("orange"), 0U);
}

TEST(Families, ADeskIsMostlyNotGraspable)
{
  int graspable = 0, objects = 0;
  for (const auto& [object, count] : visibleAffordances("desk", GraspDefinition())) {
    EXPECT_TRUE(object == "mug" || object == "pen" || object == "marker" || object == "monitor") << object;
    graspable += count;
  }
  for (const char* name : {"desk1", "desk2"}) {
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
      objects += static_cast<int>(placedObjects(makeScene(name, seed)).size());
  }
  EXPECT_LT(graspable, objects / 4);
  EXPECT_GT(graspable, 0);
}

TEST(Interpenetration, IsFoundWhereSolidsOverlapAndNotWhereTheyTouch)
{
  const auto overlap = [](double distance) {
    Scene scene;
    scene.beginObject("box");
    scene.add(Box{{0.1, 0.1, 0.1}}, Eigen::Isometry3d::Identity());
    scene.beginObject("tube");
    scene.add(Cylinder{0.05, 0.1, 0.003}, Eigen::Isometry3d(Eigen::Translation3d(distance, 0.0, 0.0)));
    return interpenetrate(scene, 0, 1);
  };
  EXPECT_FALSE(overlap(0.1));
  EXPECT_TRUE(overlap(0.096));
}

}  // namespace
}  // namespace grasp_affordances
