#pragma once

#include "simulation/counter_random.h"
#include "simulation/scene.h"

namespace grasp_affordances
{

// Handles of doors, drawers and appliances. Each function returns a scene with one object of random size. It is mounted
// on the plane x = 0; x points outwards, y to the right as seen from outside, and z up. All lengths are in metres.

/// A bar along y on two posts, 10 to 18 cm long. Of four in five, a finger of 2.5 cm fits behind it; of the others,
/// none.
Scene randomBarHandle(CounterRandom& random);
/// An arc along y, 2.5 to 5 cm before the plane in its middle.
Scene randomBowHandle(CounterRandom& random);
/// A bar along y on two legs with rounded corners.
Scene randomStapleHandle(CounterRandom& random);
/// A knob on a stem; some are too thick to be grasped.
Scene randomKnob(CounterRandom& random);
/// A lever on a stem, towards +y; round, or oval and seen from its broad side from outside.
Scene randomLever(CounterRandom& random);
/// A long bar along y: round, oval or a rounded box.
Scene randomApplianceHandle(CounterRandom& random);
/// As short as a switch: too short to be grasped.
Scene randomControlKnob(CounterRandom& random);

}  // namespace grasp_affordances
