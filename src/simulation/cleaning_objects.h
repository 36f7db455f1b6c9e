#pragma once

#include "simulation/counter_random.h"
#include "simulation/scene.h"

namespace grasp_affordances
{

// Things to clean with. Scenes of one object each, in a size of their own. The frame of each has its origin on the
// floor below its middle, z up; what has a front or a handle has it towards +x. Metres.

/// A flat tray with raised sides, which look like handles to who sees no further than a few centimetres, and a handle.
Scene randomDustPan(CounterRandom& random);
/// Lies on its bristles; its handle hovers.
Scene randomBrush(CounterRandom& random);
/// Its neck can be grasped below the trigger head.
Scene randomSprayBottle(CounterRandom& random);
/// A canister with a handle and a cap that can be grasped.
Scene randomJug(CounterRandom& random);
/// Its bail stands up, with a grip in the middle.
Scene randomBucket(CounterRandom& random);
Scene randomSponge(CounterRandom& random);

/// A short broom that stands on its head and leans towards +x. @param reach x of the stick's upper end.
Scene randomBroom(CounterRandom& random, double reach);

}  // namespace grasp_affordances
