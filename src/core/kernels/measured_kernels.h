#pragma once

#include <cstddef>
#include <cstdint>

namespace grasp_affordances
{

/// Copies `count` points, each of which starts `step` bytes (at least 12) after the one before with x, y and z as
/// floats, at any address, into coordinate arrays.
void splitPoints(const std::uint8_t* points, std::size_t step, std::size_t count, float* x, float* y, float* z);

/// Makes `count` points that do not count as measured (see Cloud) NaN in all three coordinates.
void blankUnmeasured(float* x, float* y, float* z, std::size_t count);

/// Counts those of `count` numbers that are not NaN.
std::size_t countMeasured(const float* x, std::size_t count);

/// Lists the indices, in order, of those of the numbers x that are not NaN.
/// @param room  how many there are; nothing is written beyond
void listMeasured(const float* x, std::size_t count, std::uint32_t* list, std::size_t room);

/// Copies the vectors at `count` indices, without those that are NaN.
/// @param from  three coordinate arrays
/// @param to  three coordinate arrays with room for `count` numbers
/// @return how many vectors were copied
std::size_t gatherMeasured(const float* const from[3], const std::uint32_t* index, std::size_t count,
                           float* const to[3]);

}  // namespace grasp_affordances
