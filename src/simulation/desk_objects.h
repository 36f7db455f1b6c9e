#pragma once

#include "simulation/counter_random.h"
#include "simulation/scene.h"

namespace grasp_affordances
{

// Things on a desk, most of which cannot be grasped. Each function returns a scene with one object of random size, or
// several that belong together. Its frame has the origin on the desk below the object's middle, and z up; a front
// points towards +x. All lengths are in metres.

/// Several objects: a cup with pens and markers that lean on its rim, close together.
Scene randomPenCup(CounterRandom& random);
/// A flat screen on a post; its front swallows the light.
Scene randomMonitor(CounterRandom& random);
/// Rows of keys along y.
Scene randomKeyboard(CounterRandom& random);
/// A cable that lies in bends.
Scene randomCable(CounterRandom& random);
/// A marker that lies along y.
Scene randomMarker(CounterRandom& random);

}  // namespace grasp_affordances
