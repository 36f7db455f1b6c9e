#include "fuzz/core_input.h"

#include "grasp_affordances/parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace grasp_affordances::fuzz
{
namespace
{

constexpr std::size_t kMostPoints = 1536;  // of all views together
constexpr int kMostSamples = 32;
constexpr double kMostCells = 3000;  // of the table in which the shell search counts points

const double kCaptureRadii[] = {0.002, 0.01, 0.026, 0.045, 0.1, 0.5};
const float kScaleValues[kScales] = {1.0F, 0.1F, 0.01F, 1e-3F, 1e-20F, 1e-38F, 1e3F, 1e9F, 1e18F, 1e30F};
const float kSpecials[] = {std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::infinity(),
                           -std::numeric_limits<float>::infinity(),
                           std::numeric_limits<float>::max(),
                           -std::numeric_limits<float>::max(),
                           std::numeric_limits<float>::min(),
                           std::numeric_limits<float>::denorm_min(),
                           -std::numeric_limits<float>::denorm_min(),
                           0.0F,
                           -0.0F,
                           1e30F,
                           -1e30F,
                           1e19F,
                           1.8e19F,
                           1e-20F,
                           1e-30F};

/// Sets the parameter of one number to a place in its range.
class Override
{
public:
  Override(unsigned parameter, unsigned value) : parameter_(parameter), value_(value) {}

  template <typename T>
  void operator()(const char*, T& field, const Range<T>& range, const char*, const char*)
  {
    if (isChosen()) {
      const double share = value_ / 255.0;
      const double value =
          static_cast<double>(range.min) + share * (static_cast<double>(range.max) - static_cast<double>(range.min));
      field = std::min(std::max(static_cast<T>(value), range.min), range.max);
    }
  }

  void operator()(const char*, bool& field, const char*)
  {
    if (isChosen()) {
      field = value_ % 2 != 0;
    }
  }

  template <typename Enum>
  void operator()(const char*, Enum& field, const char*)
  {
    if (isChosen()) {
      field = static_cast<Enum>(value_ % enumWords<Enum>().size());
    }
  }

private:
  bool isChosen() { return index_++ == parameter_; }

  unsigned parameter_, value_, index_ = 0;
};

bool isValid(const Config& config)
{
  try {
    validate(config);
  } catch (const ParameterError&) {
    return false;
  }
  return true;
}

/// How much the parameters ask for is theirs to answer for: here they ask for little.
void keepSmall(Config& config)
{
  config.threads = 1;
  config.sampling.samples = std::min(config.sampling.samples, kMostSamples);
  config.sampling.time_budget_ms = 0.0;
  config.estimation.curvature_points = std::min(config.estimation.curvature_points, 200);
  const ShellConfig& shell = config.shell;
  const double slices = shell.measure_length ? shell.max_length / shell.length_resolution : 1.0;
  const double least_step = config.hand.capture_radius * slices / kMostCells;
  config.shell.radius_step = std::min(0.01, std::max(shell.radius_step, least_step));
}

Config decodeConfig(ByteReader& input)
{
  Config config = presetConfig(presetNames()[input.byte() % presetNames().size()]);
  config.estimation.estimator = static_cast<Estimator>(input.byte() % 3);
  config.neighborhood.kind = static_cast<NeighborhoodKind>(input.byte() % 2);
  config.estimation.normals_mode = static_cast<NormalsMode>(input.byte() % 2);
  config.sampling.samples = 1 + input.byte() % kMostSamples;
  config.hand.capture_radius = kCaptureRadii[input.byte() % 6];
  const unsigned overrides = input.byte() % 9;
  for (unsigned i = 0; i < overrides; ++i) {
    const unsigned parameter = input.byte();
    Config changed = config;
    visitParameters(changed, Override(parameter, input.byte()));
    keepSmall(changed);
    if (isValid(changed)) {
      config = changed;
    }
  }
  keepSmall(config);
  return config;
}

PinholeIntrinsics depthIntrinsics(const Cloud& cloud, float focal_length)
{
  return {focal_length, focal_length, (cloud.width - 1) / 2.0, (cloud.height - 1) / 2.0};
}

void fillCoordinates(ByteReader& input, Cloud& cloud)
{
  for (std::size_t i = 0; i < cloud.size() && input.left() > 0; ++i) {
    const auto x = input.take<float>(), y = input.take<float>(), z = input.take<float>();
    cloud.set(i, x, y, z);
  }
}

void fillDepths(ByteReader& input, const PinholeIntrinsics& camera, float scale, Cloud& cloud)
{
  for (std::size_t i = 0; i < cloud.size() && input.left() > 0; ++i) {
    const float z = 0.001F * input.take<std::uint16_t>() * scale;
    const std::size_t column = i % cloud.width, row = i / cloud.width;
    const auto u = static_cast<double>(column), v = static_cast<double>(row);
    cloud.set(i, static_cast<float>((u - camera.cx) / camera.fx * z),
              static_cast<float>((v - camera.cy) / camera.fy * z), z);
  }
}

/// Points of one thing, in front of the sensor: what is regular in measurements seldom is, here is exactly.
Eigen::Vector3d shapePoint(unsigned shape, std::size_t i, std::size_t columns, double size)
{
  const std::size_t u = i % columns, v = i / columns;
  const auto s = static_cast<double>(i), column = static_cast<double>(u), row = static_cast<double>(v);
  const double golden = 2.399963229728653;
  const Eigen::Vector3d center(0.0, 0.0, 1.0);
  switch (shape) {
    case 0:  // one place
      return center;
    case 1:  // a line along y
      return center + Eigen::Vector3d(0.0, 0.1 * size * s, 0.0);
    case 2:  // a grid in a plane that faces the sensor
      return center + size * Eigen::Vector3d(column - columns / 2.0, row - columns / 2.0, 0.0);
    case 3:  // a cylinder about y
      return center +
             Eigen::Vector3d(10 * size * std::cos(golden * s), 0.05 * size * s, 10 * size * std::sin(golden * s));
    case 4: {  // a sphere
      const double z = std::fmod(0.618033988749895 * s, 1.0) * 2.0 - 1.0, r = std::sqrt(1.0 - z * z);
      return center + 10 * size * Eigen::Vector3d(r * std::cos(golden * s), r * std::sin(golden * s), z);
    }
    case 5: {  // a lattice in space
      const std::size_t layer = i / 64;
      return center + size * Eigen::Vector3d(i % 8, i / 8 % 8, layer);
    }
    case 6:  // two places, each many times
      return center + (i % 2) * Eigen::Vector3d(size, 0.0, 0.0);
    default:  // a spiral that ever more points close in on
      return center + 10 * size / (1.0 + s) * Eigen::Vector3d(std::cos(golden * s), std::sin(golden * s), 0.1 * s);
  }
}

void fillShape(ByteReader& input, float scale, Cloud& cloud)
{
  const unsigned shape = input.byte() % kShapes;
  const double size = 0.0001 * (1 + input.byte());
  const float jitter = 1e-5F * input.byte();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    Eigen::Vector3f point = shapePoint(shape, i, cloud.width, size).cast<float>();
    point.z() += jitter * static_cast<float>(i * 2654435761U % 1024) / 1024.0F;
    point *= scale;
    cloud.set(i, point.x(), point.y(), point.z());
  }
}

/// A coordinate or more of one point, set to a number of the table of special ones.
struct Edit
{
  std::uint16_t point;
  std::uint8_t coordinates;  // a bit for each
  std::uint8_t value;
};

std::vector<Edit> decodeEdits(ByteReader& input)
{
  std::vector<Edit> edits(input.byte() % 17);
  for (Edit& edit : edits) {
    edit.point = input.take<std::uint16_t>();
    edit.coordinates = input.byte();
    edit.value = input.byte();
  }
  return edits;
}

void apply(const std::vector<Edit>& edits, Cloud& cloud)
{
  for (const Edit& edit : edits) {
    if (cloud.size() == 0) {
      return;
    }
    const std::size_t i = edit.point % cloud.size();
    const float value = kSpecials[edit.value % 16];
    cloud.set(i, (edit.coordinates & 1) != 0 ? value : cloud.x[i], (edit.coordinates & 2) != 0 ? value : cloud.y[i],
              (edit.coordinates & 4) != 0 ? value : cloud.z[i]);
  }
}

Eigen::Isometry3d decodePose(ByteReader& input)
{
  if (input.byte() % 2 == 0) {
    return Eigen::Isometry3d::Identity();
  }
  Eigen::Vector3d position;
  Eigen::Quaterniond orientation;
  for (int i = 0; i < 3; ++i) {
    position[i] = input.take<float>();
  }
  for (int i = 0; i < 4; ++i) {
    orientation.coeffs()[i] = input.take<std::int8_t>() / 127.0;
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = position;
  if (orientation.norm() > 0.0) {
    pose.linear() = orientation.normalized().toRotationMatrix();
  }
  return pose;
}

Cloud decodeCloud(ByteReader& input, std::size_t room)
{
  Cloud cloud;
  const auto filling = static_cast<Filling>(input.byte() % kFillings);
  const auto intrinsics = static_cast<Intrinsics>(input.byte() % kIntrinsics);
  const float scale = kScaleValues[input.byte() % kScales];
  const std::uint32_t width = std::max<std::uint32_t>(1, input.byte());
  const auto height = static_cast<std::uint32_t>(std::min<std::size_t>(input.byte(), room / width));
  const bool organized = input.byte() % 2 == 0;
  const float focal_length = input.take<std::uint16_t>();
  cloud.reset(organized ? width : width * height, organized ? height : std::min(height, 1U));
  const std::vector<Edit> edits = decodeEdits(input);
  if (intrinsics == Intrinsics::right) {
    cloud.intrinsics = depthIntrinsics(cloud, focal_length);
  } else if (intrinsics == Intrinsics::wrong) {
    const auto fx = input.take<float>(), fy = input.take<float>(), cx = input.take<float>(), cy = input.take<float>();
    cloud.intrinsics = PinholeIntrinsics{fx, fy, cx, cy};
  }
  switch (filling) {
    case Filling::coordinates:
      fillCoordinates(input, cloud);
      break;
    case Filling::depths:
      fillDepths(input, depthIntrinsics(cloud, focal_length), scale, cloud);
      break;
    case Filling::shape:
      fillShape(input, scale, cloud);
      break;
  }
  apply(edits, cloud);
  return cloud;
}

/// What decodeConfig reads: `config` and a fair number of samples.
ByteWriter encodeConfig(const SeedConfig& config)
{
  ByteWriter output;
  output.byte(config.preset).byte(config.estimator).byte(config.kind).byte(config.normals_mode);
  return output.byte(15).byte(config.capture_radius).byte(0);
}

/// What decodeCloud reads before the points.
void encodeHeader(ByteWriter& output, Filling filling, Intrinsics intrinsics, unsigned scale, const Cloud& cloud)
{
  output.byte(static_cast<unsigned>(filling)).byte(static_cast<unsigned>(intrinsics)).byte(scale);
  output.byte(cloud.width).byte(cloud.height).byte(cloud.organized() ? 0 : 1);
  output.put(static_cast<std::uint16_t>(cloud.intrinsics ? std::lround(cloud.intrinsics->fx) : 0)).byte(0);
}

}  // namespace

CoreInput decodeCoreInput(ByteReader& input)
{
  CoreInput decoded;
  decoded.config = decodeConfig(input);
  const unsigned flags = input.byte();
  decoded.again = (flags & 4) != 0;
  const unsigned views = 1 + (flags & 3) % 3;
  std::size_t room = kMostPoints;
  for (unsigned i = 0; i < views; ++i) {
    decoded.poses.push_back(decodePose(input));
    decoded.clouds.push_back(decodeCloud(input, room));
    if ((flags & 8) != 0) {
      decoded.clouds.back().sensor_origin = Eigen::Vector3f::Zero();
    }
    room -= decoded.clouds.back().size();
  }
  return decoded;
}

std::string encodeDepths(const SeedConfig& config, const std::vector<Cloud>& clouds, Intrinsics intrinsics)
{
  ByteWriter output = encodeConfig(config);
  output.byte(static_cast<unsigned>(clouds.size()) - 1);
  for (const Cloud& cloud : clouds) {
    output.byte(0);
    encodeHeader(output, Filling::depths, intrinsics, 0, cloud);
    for (const float z : cloud.z) {
      output.put(static_cast<std::uint16_t>(std::isnan(z) ? 0 : std::lround(1000 * z)));
    }
  }
  return output.bytes();
}

std::string encodeCoordinates(const SeedConfig& config, const Cloud& cloud)
{
  ByteWriter output = encodeConfig(config);
  output.byte(4 | 8).byte(0);
  encodeHeader(output, Filling::coordinates, Intrinsics::none, 0, cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    output.put(cloud.x[i]).put(cloud.y[i]).put(cloud.z[i]);
  }
  return output.bytes();
}

std::string encodeShape(const SeedConfig& config, unsigned shape, unsigned scale)
{
  Cloud cloud;
  cloud.width = 32;
  cloud.height = 32;
  ByteWriter output = encodeConfig(config);
  output.byte(0).byte(0);
  encodeHeader(output, Filling::shape, Intrinsics::none, scale, cloud);
  return output.byte(shape).byte(10).byte(10).bytes();
}

}  // namespace grasp_affordances::fuzz
