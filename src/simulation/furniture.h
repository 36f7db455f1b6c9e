#pragma once

#include "simulation/counter_random.h"
#include "simulation/scene.h"

namespace grasp_affordances
{

/// A piece of furniture of random kind and size, an object of Role::background. It stands on z = 0 about the origin and
/// reaches less than 0.6 m from the vertical axis. Legs and posts of some kinds are thin enough for a hand.
Scene randomFurniture(CounterRandom& random);

}  // namespace grasp_affordances
