#pragma once

#include "simulation/counter_random.h"
#include "simulation/scene.h"

namespace grasp_affordances
{

// Cleaning tools. Each function returns a scene with one object of random size. Its frame has the origin on the floor
// below the object's middle, and z up; a front or handle points towards +x. All lengths are in metres.

/// A flat tray with a handle, and with raised sides that look like handles in a neighborhood of a few centimetres.
Scene randomDustPan(CounterRandom& random);
/// Lies on its bristles, so that its handle is above the floor.
Scene randomBrush(CounterRandom& random);
/// Its neck can be grasped below the trigger head.
Scene randomSprayBottle(CounterRandom& random);
/// A canister with a handle and a cap that can be grasped.
Scene randomJug(CounterRandom& random);
/// Its bail stands upright and has a grip in the middle.
Scene randomBucket(CounterRandom& random);
Scene randomSponge(CounterRandom& random);

/// A short broom that stands on its head and leans towards +x. @param reach x of the stick's upper end.
Scene randomBroom(CounterRandom& random, double reach);

}  // namespace grasp_affordances
