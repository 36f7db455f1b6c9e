#pragma once

#include "simulation/counter_random.h"
#include "simulation/scene.h"

namespace grasp_affordances
{

// What a supermarket sells, for hands with a capture radius of 4.5 cm. Each function returns a scene with one object of
// random size. Its frame has the origin on the supporting surface below the object's middle, and z up. All lengths are
// in metres.

/// A can of 33 to 37.5 mm radius.
Scene randomTin(CounterRandom& random);
/// A bottle with a cap; bodies of 30 to 44 mm radius.
Scene randomDrinkBottle(CounterRandom& random);
/// A square carton with a cap; some are too thick.
Scene randomMilkCarton(CounterRandom& random);
/// A flat box that stands upright.
Scene randomPackage(CounterRandom& random);
Scene randomOrange(CounterRandom& random);
/// Lies along x.
Scene randomLemon(CounterRandom& random);

}  // namespace grasp_affordances
