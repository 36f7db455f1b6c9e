#pragma once

#include "simulation/counter_random.h"
#include "simulation/scene.h"

namespace grasp_affordances
{

// Household objects. Each function returns a scene with one object of random size. Its frame has the origin on the
// supporting surface below the object's middle, and z up; a front or handle points towards +x. All lengths are in
// metres.

Scene randomLamp(CounterRandom& random);
/// Lies on its bristles, so that its handle is above the surface.
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
/// Two objects: it lies on a block, and one of its ends extends over the block's edge.
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
/// A bar along y on a wall, the plane x = 0. It is so close to the wall that no finger fits between.
Scene randomCloseBar(CounterRandom& random);
/// The same on the front of a block.
Scene randomBlockWithCloseBar(CounterRandom& random);

}  // namespace grasp_affordances
