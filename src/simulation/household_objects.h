#pragma once

#include "simulation/counter_random.h"
#include "simulation/scene.h"

namespace grasp_affordances
{

// Things about the house. Scenes of one object each, in a size of their own. The frame of each has its origin on the
// support below its middle, z up; what has a front or a handle has it towards +x. Metres.

Scene randomLamp(CounterRandom& random);
/// Lies on its bristles; its handle hovers.
Scene randomHairBrush(CounterRandom& random);
/// Stands on its head.
Scene randomHammer(CounterRandom& random);
/// A handset, upright in its base.
Scene randomPhone(CounterRandom& random);
/// Stands on its wide head.
Scene randomFlashlight(CounterRandom& random);
/// A roll, lying flat.
Scene randomTape(CounterRandom& random);
Scene randomBook(CounterRandom& random);
/// As large as a carton of cereals.
Scene randomCarton(CounterRandom& random);
/// An open carton: four walls and a floor.
Scene randomOpenCarton(CounterRandom& random);
/// Too thick to be grasped, with a cap that is too short.
Scene randomLotionBottle(CounterRandom& random);
Scene apple(double radius);
/// Too wide to be grasped.
Scene randomApple(CounterRandom& random);
/// Lies on a block that one of its ends stands out from: two objects.
Scene randomBananaOnBlock(CounterRandom& random);
/// Its handle is on top.
Scene randomSuitcase(CounterRandom& random);
/// Lies flat; its handle is at the side.
Scene randomLyingSuitcase(CounterRandom& random);
/// Has a loop on top.
Scene randomBackpack(CounterRandom& random);
/// Lies along y.
Scene randomLongBox(CounterRandom& random);
/// A board on two others.
Scene randomShelf(CounterRandom& random);
/// A bar along y, too close for a finger to the wall that it is mounted on: the plane x = 0.
Scene randomCloseBar(CounterRandom& random);
/// The same on the front of a block.
Scene randomBlockWithCloseBar(CounterRandom& random);

}  // namespace grasp_affordances
