#pragma once

#include "simulation/counter_random.h"
#include "simulation/scene.h"

namespace grasp_affordances
{

// Tools whose grips are rounded boxes and ovals. Each function returns a scene with one object of random size, or
// several that belong together. Its frame has the origin on the supporting surface below the object's middle, and z up;
// a front or handle points towards +x. All lengths are in metres.

/// A cordless drill that stands on its battery; pistol grip and chuck can be grasped.
Scene randomDrill(CounterRandom& random);
/// Two objects: pliers on a block; their handles extend over its edge.
Scene randomPliersOnBlock(CounterRandom& random);
/// Stands on its head; its handle is an oval.
Scene randomClawHammer(CounterRandom& random);
/// Two to three screwdrivers that stand in a rack along y, handles up.
Scene randomScrewdriverRack(CounterRandom& random);
/// An iron with a closed handle above its body.
Scene randomIron(CounterRandom& random);
/// Lies on its barrel; its handle points up.
Scene randomHairDryer(CounterRandom& random);
/// Its spout points towards +x, its handle is an arc at the back.
Scene randomWateringCan(CounterRandom& random);

}  // namespace grasp_affordances
