#include "simulation/everyday_scenes.h"

#include "simulation/arrangement.h"
#include "simulation/counter_random.h"
#include "simulation/desk_objects.h"
#include "simulation/groceries.h"
#include "simulation/hand_tools.h"
#include "simulation/household_objects.h"
#include "simulation/tableware.h"

#include <cstddef>
#include <utility>

namespace grasp_affordances
{
namespace
{

using MakeObject = Scene (*)(CounterRandom& random);

// Direction of an object's front, in degrees.
constexpr double kTowardsCamera = -90.0;

View workshop(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  Stage stage;
  stage.middle_height = 0.09;
  stage.max_distance = 0.95;
  Arrangement arrangement(stage, random);
  arrangement.place(randomDrill(random), {{-0.18, 0.08}, {0.03, 0.03}, kTowardsCamera, 120.0});
  arrangement.place(randomScrewdriverRack(random), {{0.16, 0.16}, {0.03, 0.03}, kTowardsCamera, 60.0});
  arrangement.place(randomPliersOnBlock(random), {{-0.05, -0.13}, {0.03, 0.02}, -60.0, 60.0});
  arrangement.place(randomClawHammer(random), {{0.2, -0.04}, {0.03, 0.03}});
  return arrangement.view();
}

View houseAndGarden(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  Stage stage;
  stage.middle_height = 0.09;
  stage.min_distance = 0.8;
  stage.max_distance = 1.0;
  Arrangement arrangement(stage, random);
  arrangement.place(randomWateringCan(random), {{-0.2, 0.13}, {0.03, 0.03}, 0.0, 80.0});
  arrangement.place(randomIron(random), {{-0.06, -0.12}, {0.03, 0.03}, kTowardsCamera, 120.0});
  arrangement.place(randomHairDryer(random), {{0.2, 0.12}, {0.03, 0.03}, kTowardsCamera, 120.0});
  arrangement.place(randomScrewdriverRack(random), {{0.22, -0.1}, {0.03, 0.02}, kTowardsCamera, 60.0});
  return arrangement.view();
}

/// Places objects of kinds that are drawn one after another, each kind at most `of_a_kind` times.
void fill(Arrangement& arrangement, CounterRandom& random, std::vector<MakeObject> kinds, int of_a_kind, int objects)
{
  std::vector<MakeObject> all;
  for (int i = 0; i < of_a_kind; ++i)
    all.insert(all.end(), kinds.begin(), kinds.end());
  int placed = 0;
  while (placed < objects && !all.empty()) {
    const auto i = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(all.size())));
    placed += arrangement.tryToPlace(all[i](random), {{0.0, 0.02}, {0.28, 0.17}, kTowardsCamera, 60.0}, 100) ? 1 : 0;
    std::swap(all[i], all.back());
    all.pop_back();
  }
}

View checkout(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  Stage stage;
  stage.middle_height = 0.07;
  stage.max_distance = 0.95;
  Arrangement arrangement(stage, random);
  arrangement.setGap(0.03);
  fill(arrangement, random,
       {randomTin, randomDrinkBottle, randomMilkCarton, randomPackage, randomOrange, randomApple, randomLemon}, 2, 8);
  return arrangement.view();
}

/// A shelf with a back.
View shelf(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  Stage stage;
  stage.table_size = {1.0, 0.5};
  stage.wall = 0.4;
  stage.middle_height = 0.1;
  stage.min_elevation = 10.0;
  stage.max_elevation = 35.0;
  Arrangement arrangement(stage, random);
  arrangement.setGap(0.025);
  fill(arrangement, random, {randomTin, randomDrinkBottle, randomMilkCarton, randomPackage, randomCarton}, 2, 7);
  return arrangement.view();
}

View writingDesk(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  Arrangement arrangement(Stage{}, random);
  arrangement.place(randomKeyboard(random), {{-0.05, -0.12}, {0.03, 0.02}, kTowardsCamera, 12.0});
  arrangement.place(randomPenCup(random), {{0.2, 0.12}, {0.03, 0.03}});
  arrangement.place(randomMug(random), {{-0.22, 0.1}, {0.03, 0.03}, kTowardsCamera, 110.0});
  arrangement.place(randomCable(random), {{-0.02, 0.14}, {0.03, 0.03}});
  arrangement.place(randomMarker(random), {{0.22, -0.06}, {0.02, 0.03}});
  return arrangement.view();
}

View computerDesk(std::uint64_t seed)
{
  CounterRandom random(seed, RandomStream::placement);
  Stage stage;
  stage.middle_height = 0.1;
  stage.min_distance = 0.8;
  stage.max_distance = 1.0;
  stage.max_elevation = 38.0;
  Arrangement arrangement(stage, random);
  arrangement.place(randomMonitor(random), {{-0.06, 0.18}, {0.03, 0.02}, kTowardsCamera, 15.0});
  arrangement.place(randomKeyboard(random), {{-0.05, -0.1}, {0.02, 0.02}, kTowardsCamera, 10.0});
  arrangement.place(randomPenCup(random), {{0.24, 0.1}, {0.02, 0.03}});
  arrangement.place(randomCable(random), {{0.24, -0.08}, {0.02, 0.03}});
  arrangement.place(randomBook(random), {{-0.3, 0.02}, {0.02, 0.02}, 90.0, 15.0});
  return arrangement.view();
}

}  // namespace

std::vector<NamedScene> everydayScenes()
{
  return {
      {"tools1", "tools", "cordless drill, screwdrivers in a rack, pliers on a block, claw hammer", workshop},
      {"tools2", "tools", "watering can, iron, hair dryer, screwdrivers in a rack", houseAndGarden},
      {"supermarket1", "supermarket", "tins, bottles, cartons, packages and fruit, for hands of 4.5 cm", checkout},
      {"supermarket2", "supermarket", "tins, bottles, cartons and boxes close to a shelf's back", shelf},
      {"desk1", "desk", "keyboard, pens in a cup, mug, cable, marker: mostly not graspable", writingDesk},
      {"desk2", "desk", "monitor, keyboard, pens in a cup, cable, book: mostly not graspable", computerDesk},
  };
}

}  // namespace grasp_affordances
