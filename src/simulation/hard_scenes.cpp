#include "simulation/hard_scenes.h"

#include "simulation/arrangement.h"
#include "simulation/cleaning_objects.h"
#include "simulation/counter_random.h"
#include "simulation/household_objects.h"
#include "simulation/tableware.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

namespace grasp_affordances
{
namespace
{

using MakeObject = Scene (*)(CounterRandom& random);

std::size_t drawIndex(CounterRandom& random, std::size_t count)
{
  return static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(count)));
}

MakeObject draw(CounterRandom& random, const std::vector<MakeObject>& kinds)
{
  return kinds[drawIndex(random, kinds.size())];
}

void shuffle(CounterRandom& random, std::vector<MakeObject>& kinds)
{
  for (std::size_t i = kinds.size(); i > 1; --i)
    std::swap(kinds[i - 1], kinds[drawIndex(random, i)]);
}

View far(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  Stage stage;
  stage.min_distance = 1.33;
  stage.max_distance = 1.37;
  stage.nearest_object = 1.2;
  stage.farthest_object = 1.5;
  stage.support = random.coin() ? Stage::Support::table : Stage::Support::floor;
  Arrangement arrangement(stage, random);
  arrangement.setGap(0.03);
  std::vector<MakeObject> graspable = {randomMug,        randomKettle, randomPot,    randomPan,
                                       randomRollingPin, randomHammer, randomLamp,   randomDustPan,
                                       randomBrush,      randomJug,    randomBucket, randomMug};
  shuffle(random, graspable);
  const Spot spot{{0.0, 0.0}, {0.4, 0.13}, -90.0, 110.0};
  int placed = 0;
  for (std::size_t i = 0; i < graspable.size() && placed < 5; ++i)
    placed += arrangement.tryToPlace(graspable[i](random), spot, 200) ? 1 : 0;
  for (const MakeObject make : {randomCarton, randomBowl, randomCan})
    arrangement.tryToPlace(make(random), spot, 200);
  return arrangement.view();
}

/// Turns an object so that its front points up, and places it on z = 0.
Scene laidDown(const Scene& object)
{
  const Eigen::Isometry3d turn = turned(-0.5 * kPi, Eigen::Vector3d::UnitY());
  double lowest = 0.0;
  for (std::size_t i = 0; i < object.objects().size(); ++i) {
    for (const Eigen::Vector3d& point : pointsInside(object, i))
      lowest = std::min(lowest, (turn * point).z());
  }
  constexpr double depth_of_points = 0.0015;
  Scene scene;
  append(object, at(0.0, 0.0, depth_of_points - lowest) * turn, scene);
  return scene;
}

View clutter(std::uint64_t seed)
{
  constexpr int min_objects = 26;
  CounterRandom random(seed, RandomStream::placement);
  Stage stage;
  stage.min_distance = 0.85;
  stage.max_distance = 1.0;
  stage.min_elevation = 35.0;
  stage.max_elevation = 50.0;
  Arrangement arrangement(stage, random);
  arrangement.setGap(0.0);

  // Boxes first, because objects are stacked on them; then large objects, while there is room.
  const Spot anywhere{{0.0, 0.03}, {0.31, 0.22}};
  std::vector<Spot> spots = {anywhere, anywhere};
  int objects = 0;
  for (const MakeObject make : {randomCarton, randomCarton, randomBook, randomBook}) {
    const Scene box = make(random);
    const Eigen::Vector2d middle = arrangement.place(box, anywhere).translation().head<2>();
    const double height = std::get<Box>(box.parts().front().shape).size.z();
    spots.push_back({middle, {0.02, 0.02}, 0.0, 180.0, height});
    ++objects;
  }
  std::vector<MakeObject> large = {randomKettle,        randomPot,     randomPan,
                                   randomBowlWithLadle, randomDustPan, randomRollingPin};
  shuffle(random, large);
  large.resize(2);
  for (const MakeObject make : large) {
    arrangement.place(make(random), anywhere);
    ++objects;
  }

  const std::vector<MakeObject> upright_or_lying = {randomMug, randomDressingBottle, randomSprayBottle, randomJug,
                                                    randomLotionBottle};
  const std::vector<MakeObject> upright_only = {randomApple, randomMug,    randomCan,        randomCup,
                                                randomTape,  randomHammer, randomFlashlight, randomLyingCan,
                                                randomPhone, randomSponge, randomHairBrush,  randomBrush};
  for (int attempt = 0; objects < min_objects; ++attempt) {
    if (attempt == 5000)
      throw std::runtime_error("no room for so much clutter");
    const bool may_lie = random.coin();
    Scene object = draw(random, may_lie ? upright_or_lying : upright_only)(random);
    if (may_lie && random.coin())
      object = laidDown(object);
    if (arrangement.tryToPlace(object, spots[drawIndex(random, spots.size())], 10))
      ++objects;
  }
  return arrangement.view();
}

/// Bars on a wall, above objects that stand in front of it; or a table with visible edges.
View distractors(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  const bool wall = random.coin();
  Stage stage;
  stage.middle_height = 0.08;
  if (wall) {
    stage.support = Stage::Support::floor;
    stage.wall = 0.3;
    stage.max_elevation = 38.0;
  } else {
    stage.table_size = {0.8, 0.64};
  }
  Arrangement arrangement(stage, random);
  if (wall) {
    for (const double x : {-0.2, 0.15}) {
      const double height = random.uniform(0.13, 0.2);
      arrangement.place(randomCloseBar(random), {{x, stage.wall}, {0.06, 0.0}, -90.0, 0.0, height});
    }
  }
  std::vector<MakeObject> kinds = {randomBlockWithCloseBar,
                                   randomOpenCarton,
                                   randomShelf,
                                   randomCarton,
                                   randomLongBox,
                                   randomBook,
                                   randomBowl,
                                   randomPlate,
                                   randomCup,
                                   randomCan,
                                   randomLyingCan,
                                   randomTape,
                                   randomLotionBottle};
  shuffle(random, kinds);
  kinds.resize(8);
  for (const MakeObject make : kinds)
    arrangement.tryToPlace(make(random), {{0.0, 0.02}, {0.27, 0.18}, -90.0, 70.0}, 100);
  return arrangement.view();
}

}  // namespace

std::vector<NamedScene> hardScenes()
{
  return {
      {"far", "far", "up to five objects with handles and up to three without, 1.2 to 1.5 m away", far},
      {"clutter", "clutter", "26 objects upright, lying and on top of one another, close together", clutter},
      {"distractors", "distractors", "nothing to grasp: boxes, edges, corners, vessels, bars too close to a wall",
       distractors},
  };
}

}  // namespace grasp_affordances
