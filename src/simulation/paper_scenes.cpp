#include "simulation/paper_scenes.h"

#include "simulation/arrangement.h"
#include "simulation/cleaning_objects.h"
#include "simulation/counter_random.h"
#include "simulation/household_objects.h"
#include "simulation/tableware.h"

namespace grasp_affordances
{
namespace
{

// Directions of an object's front, in degrees.
constexpr double kToTheRight = 0.0;
constexpr double kAway = 90.0;
constexpr double kToTheCamera = -90.0;

/// Places a broom on the floor so that it leans on a wall.
void leanBroom(Arrangement& arrangement, CounterRandom& random, double x, double wall)
{
  const double reach = random.uniform(0.06, 0.1);
  const double end_of_stick = 0.016;
  arrangement.place(randomBroom(random, reach), {{x, wall - reach - end_of_stick}, {0.03, 0.0}, kAway, 0.0});
}

View mugs(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  Arrangement arrangement(Stage{}, random);
  for (const Eigen::Vector2d& middle :
       std::vector<Eigen::Vector2d>{{-0.24, -0.07}, {0.0, -0.12}, {0.23, -0.06}, {-0.12, 0.13}, {0.14, 0.15}}) {
    arrangement.place(randomMug(random), {middle, {0.03, 0.03}, kToTheCamera, 110.0});
  }
  return arrangement.view();
}

View cleaning1(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  Arrangement arrangement(Stage{}, random);
  arrangement.place(randomDustPan(random), {{-0.14, 0.08}, {0.02, 0.02}, -50.0, 35.0});
  arrangement.place(randomSprayBottle(random), {{0.2, 0.14}, {0.03, 0.03}, kToTheCamera, 120.0});
  arrangement.place(randomBrush(random), {{0.13, -0.1}, {0.03, 0.02}, kToTheRight, 50.0});
  arrangement.place(randomSponge(random), {{-0.2, -0.14}});
  return arrangement.view();
}

View kitchen1(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  Arrangement arrangement(Stage{}, random);
  arrangement.place(randomFrenchPress(random), {{-0.22, 0.04}, {0.03, 0.03}, kToTheCamera, 100.0});
  arrangement.place(randomLotionBottle(random), {{0.0, 0.04}});
  arrangement.place(randomLongBox(random), {{0.25, 0.0}, {0.02, 0.03}, kAway, 40.0});
  arrangement.place(randomMug(random), {{0.04, -0.14}, {0.04, 0.02}, kToTheCamera, 110.0});
  arrangement.place(randomDressingBottle(random), {{0.13, 0.2}, {0.04, 0.02}});
  return arrangement.view();
}

View cleaning2(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  Stage stage;
  stage.support = Stage::Support::floor;
  stage.wall = 0.36;
  stage.middle_height = 0.14;
  stage.min_distance = 0.84;
  stage.max_distance = 0.9;
  stage.min_elevation = 25.0;
  stage.max_elevation = 30.0;
  Arrangement arrangement(stage, random);
  leanBroom(arrangement, random, 0.22, stage.wall);
  arrangement.place(randomJug(random), {{-0.2, 0.14}, {0.02, 0.02}, kToTheCamera, 80.0});
  arrangement.place(randomSprayBottle(random), {{0.01, 0.12}, {0.02, 0.02}, kToTheCamera, 80.0});
  arrangement.place(randomDustPan(random), {{0.17, 0.01}, {0.02, 0.02}, -75.0, 20.0});
  arrangement.place(randomBananaOnBlock(random), {{-0.21, -0.08}, {0.02, 0.02}});
  // Round and small enough to be certain, not doubtful, in the ground truth at this range.
  arrangement.place(apple(random.uniform(0.0262, 0.0267)), {{-0.01, -0.17}, {0.03, 0.02}});
  return arrangement.view();
}

View household1(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  Stage stage;
  stage.middle_height = 0.1;
  stage.min_distance = 0.8;
  stage.max_distance = 0.95;
  Arrangement arrangement(stage, random);
  arrangement.place(randomLamp(random), {{-0.22, 0.14}});
  arrangement.place(randomHammer(random), {{0.18, 0.12}, {0.03, 0.03}});
  arrangement.place(randomBook(random), {{-0.03, 0.16}, {0.02, 0.02}, kAway, 25.0});
  arrangement.place(randomHairBrush(random), {{-0.04, -0.12}, {0.03, 0.03}, kToTheRight, 60.0});
  arrangement.place(randomTape(random), {{-0.23, -0.08}});
  arrangement.place(randomFlashlight(random), {{0.22, -0.06}});
  return arrangement.view();
}

View household2(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  Arrangement arrangement(Stage{}, random);
  arrangement.place(randomPhone(random), {{-0.19, 0.08}, {0.03, 0.03}, kToTheCamera, 60.0});
  arrangement.place(randomCup(random), {{0.01, 0.1}});
  arrangement.place(randomFlashlight(random), {{0.2, 0.12}});
  arrangement.place(randomBook(random), {{0.2, -0.09}, {0.02, 0.02}});
  arrangement.place(randomMug(random), {{0.0, -0.12}, {0.03, 0.03}, kToTheCamera, 110.0});
  arrangement.place(randomHairBrush(random), {{-0.22, -0.12}, {0.03, 0.02}, kToTheRight, 60.0});
  return arrangement.view();
}

View kitchen2(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  Stage stage;
  stage.middle_height = 0.08;
  stage.min_distance = 0.8;
  stage.max_distance = 0.95;
  Arrangement arrangement(stage, random);
  arrangement.place(randomKettle(random), {{-0.2, 0.0}, {0.02, 0.03}, -60.0, 50.0});
  arrangement.place(randomPot(random), {{0.14, -0.06}, {0.02, 0.02}, kToTheRight, 60.0});
  for (const double x : {0.0, 0.11, 0.23})
    arrangement.place(randomDressingBottle(random), {{x, 0.18}, {0.02, 0.03}});
  return arrangement.view();
}

View kitchen3(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  Stage stage;
  stage.min_distance = 0.85;
  stage.max_distance = 1.0;
  Arrangement arrangement(stage, random);
  arrangement.place(randomPan(random), {{-0.2, 0.0}, {0.02, 0.03}, -65.0, 30.0});
  arrangement.place(randomBowlWithLadle(random), {{0.15, 0.09}, {0.02, 0.02}, kToTheRight, 60.0});
  arrangement.place(randomRollingPin(random), {{0.15, -0.15}, {0.03, 0.02}, kToTheRight, 20.0});
  arrangement.place(randomMug(random), {{-0.3, 0.2}, {0.03, 0.02}, kToTheCamera, 110.0});
  arrangement.place(randomPlate(random), {{-0.05, 0.24}, {0.02, 0.02}});
  return arrangement.view();
}

View luggage(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  Stage stage;
  stage.support = Stage::Support::floor;
  stage.middle_height = 0.14;
  stage.min_distance = 0.92;
  stage.max_distance = 1.0;
  stage.min_elevation = 26.0;
  stage.max_elevation = 40.0;
  Arrangement arrangement(stage, random);
  arrangement.place(randomSuitcase(random), {{-0.22, 0.18}, {0.02, 0.03}, kToTheCamera, 20.0});
  arrangement.place(randomLyingSuitcase(random), {{0.16, -0.03}, {0.03, 0.02}, kToTheCamera, 15.0});
  arrangement.place(randomBackpack(random), {{0.2, 0.28}, {0.03, 0.02}, kToTheCamera, 30.0});
  return arrangement.view();
}

View cleaning3(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  Stage stage;
  stage.support = Stage::Support::floor;
  stage.wall = 0.4;
  stage.middle_height = 0.14;
  stage.min_distance = 0.88;
  stage.max_distance = 1.0;
  stage.min_elevation = 25.0;
  stage.max_elevation = 33.0;
  Arrangement arrangement(stage, random);
  leanBroom(arrangement, random, -0.26, stage.wall);
  arrangement.place(randomBucket(random), {{-0.12, 0.06}, {0.03, 0.03}, kToTheCamera, 70.0});
  arrangement.place(randomJug(random), {{0.22, 0.15}, {0.02, 0.02}, kToTheCamera, 80.0});
  arrangement.place(randomSprayBottle(random), {{0.1, -0.03}, {0.02, 0.02}, kToTheCamera, 120.0});
  arrangement.place(randomSponge(random), {{-0.1, -0.16}});
  return arrangement.view();
}

}  // namespace

std::vector<NamedScene> paperScenes()
{
  return {
      {"mugs", "paper", "five mugs, their handles in various directions", mugs},
      {"cleaning1", "paper", "dust pan with raised sides, brush, spray bottle and sponge", cleaning1},
      {"kitchen1", "paper", "glass French press, lotion bottle too thick to grasp, horizontal box, mug and bottle",
       kitchen1},
      {"cleaning2", "paper",
       "front example of the paper, seven affordances for a capture radius of 2.9 cm: apple, end of a banana, neck of "
       "a squirt bottle, handles of dust pan, jug and broom, cap of the jug",
       cleaning2},
      {"household1", "paper", "lamp, hammer, hair brush, flashlight, book and tape", household1},
      {"household2", "paper", "cordless phone, flashlight, hair brush, mug, cup and book", household2},
      {"kitchen2", "paper", "tea kettle with its handle on top, pot and three salad dressing bottles", kitchen2},
      {"kitchen3", "paper", "pan, ladle in a bowl, rolling pin, mug and plate", kitchen3},
      {"luggage", "paper", "two suitcases, one of them lying, and a backpack, with carry handles", luggage},
      {"cleaning3", "paper", "broom, bucket with its bail up, jug, spray bottle and sponge", cleaning3},
  };
}

}  // namespace grasp_affordances
