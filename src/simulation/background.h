#pragma once

#include "simulation/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// What is behind and around the things of a scene. Things, fronts and the camera are the same with each.
enum class Background
{
  walls,  ///< the scene as it is made: floor and walls within the sensor's range
  open,   ///< nothing; the table ends 3 to 10 cm beside the things
  far,    ///< a hall whose walls and floor are 3.4 to 5 m away, some of them out of range; the table as in `open`
  room,   ///< furniture 2 to 4 m from the camera, walls behind; the table as in `open`
  dark    ///< as `walls`, with surfaces that swallow the light behind and beside the things
};

/// In the order of the enumeration.
const std::vector<std::string>& backgroundNames();

/// @throw std::invalid_argument for a name that is not one of these, with a sentence that lists them.
Background backgroundFromName(const std::string& name);

/// The same things before another background. It depends on the arguments only.
/// @param seed of sizes and places of what is added
View withBackground(const View& view, Background background, std::uint64_t seed);

}  // namespace grasp_affordances
