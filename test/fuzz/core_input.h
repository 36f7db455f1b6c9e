#pragma once

#include "fuzz/bytes.h"
#include "grasp_affordances/cloud.h"
#include "grasp_affordances/config.h"

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace grasp_affordances::fuzz
{

/// How the points of a view come out of the bytes.
enum class Filling : std::uint8_t
{
  coordinates,  ///< three floats for each point
  depths,       ///< 16 bits for each pixel: mm along its ray
  shape,        ///< a few numbers, and all points on one thing
};
constexpr unsigned kFillings = 3;

enum class Intrinsics : std::uint8_t
{
  none,
  right,  ///< those of the depths
  wrong,  ///< four floats
};
constexpr unsigned kIntrinsics = 3;

/// Clouds and parameters out of a fuzzer's bytes: any bytes give some.
struct CoreInput
{
  Config config;
  std::vector<Cloud> clouds;
  std::vector<Eigen::Isometry3d> poses;
  bool again = false;  ///< localize again, with a new localizer and scalar code, and compare
};

CoreInput decodeCoreInput(ByteReader& input);

/// Seeds: the bytes of which decodeCoreInput makes such a cloud under such parameters.
struct SeedConfig
{
  unsigned preset = 0;        // index into presetNames()
  unsigned estimator = 0;     // value of Estimator
  unsigned kind = 0;          // value of NeighborhoodKind
  unsigned normals_mode = 0;  // value of NormalsMode
  unsigned capture_radius = 2;
};

std::string encodeDepths(const SeedConfig& config, const std::vector<Cloud>& clouds, Intrinsics intrinsics);
std::string encodeCoordinates(const SeedConfig& config, const Cloud& cloud);
std::string encodeShape(const SeedConfig& config, unsigned shape, unsigned scale);

constexpr unsigned kShapes = 8;
constexpr unsigned kScales = 10;

}  // namespace grasp_affordances::fuzz
