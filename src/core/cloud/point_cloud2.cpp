#include "grasp_affordances/point_cloud2.h"

#include "core/kernels/measured_kernels.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

namespace grasp_affordances
{
namespace
{

using Coordinate = PointCloud2Layout::Coordinate;

constexpr std::uint8_t kFloat32 = 7;  // sensor_msgs/PointField
constexpr std::uint8_t kFloat64 = 8;

std::string bytes(std::uint64_t count)
{
  return std::to_string(count) + " bytes";
}

void checkCoordinate(const char* name, const Coordinate& coordinate, std::uint32_t point_step)
{
  const std::string field = std::string("field ") + name;
  if (!coordinate.present) {
    throw CloudError("the cloud has no " + field);
  }
  if (coordinate.datatype != kFloat32 && coordinate.datatype != kFloat64) {
    throw CloudError(field + " has datatype " + std::to_string(coordinate.datatype) + ", not FLOAT32 or FLOAT64");
  }
  if (coordinate.count > 1) {  // some drivers write 0 for 1
    throw CloudError(field + " has " + std::to_string(coordinate.count) + " values per point, not 1");
  }
  const std::uint64_t size = coordinate.datatype == kFloat32 ? sizeof(float) : sizeof(double);
  if (coordinate.offset + size > point_step) {
    throw CloudError(field + " (offset " + std::to_string(coordinate.offset) + ", " + bytes(size) +
                     ") lies outside the point_step of " + bytes(point_step));
  }
}

void check(const PointCloud2Layout& layout)
{
  checkCoordinate("x", layout.x, layout.point_step);
  checkCoordinate("y", layout.y, layout.point_step);
  checkCoordinate("z", layout.z, layout.point_step);
  if (layout.big_endian) {
    throw CloudError("the cloud's data is big-endian, which is not supported");
  }
  const std::uint64_t row = std::uint64_t{layout.width} * layout.point_step;
  const std::uint64_t step = rowStep(layout, layout.data_size);
  if (step < row) {
    throw CloudError("row_step of " + bytes(layout.row_step) + " is less than width " + std::to_string(layout.width) +
                     " times point_step " + std::to_string(layout.point_step));
  }
  const std::uint64_t size = layout.height * step;
  if (layout.data_size != size) {
    throw CloudError("data holds " + bytes(layout.data_size) + ", not height " + std::to_string(layout.height) +
                     " times row_step " + std::to_string(layout.row_step));
  }
  const std::uint64_t points = std::uint64_t{layout.width} * layout.height;
  if (points > kMostPoints) {
    throw CloudError("the cloud has " + std::to_string(points) + " points, more than the " +
                     std::to_string(kMostPoints) + " that are allowed");
  }
}

/// Copies one coordinate of a row. A double beyond the range of floats becomes NaN; other values that are not measured
/// are copied as they are.
template <typename T>
void copyCoordinate(const std::uint8_t* address, std::size_t step, std::size_t count, float* to)
{
  for (std::size_t i = 0; i < count; ++i, address += step) {
    T value;
    std::memcpy(&value, address, sizeof(T));
    const bool representable = std::abs(value) <= static_cast<T>(std::numeric_limits<float>::max());
    to[i] = sizeof(T) == sizeof(float) || representable ? static_cast<float>(value) : std::nanf("");
  }
}

void copyRow(const std::uint8_t* row, const PointCloud2Layout& layout, const Coordinate& coordinate, float* to)
{
  const auto copy = coordinate.datatype == kFloat32 ? copyCoordinate<float> : copyCoordinate<double>;
  copy(row + coordinate.offset, layout.point_step, layout.width, to);
}

bool areConsecutiveFloats(const PointCloud2Layout& layout)
{
  return layout.x.datatype == kFloat32 && layout.y.datatype == kFloat32 && layout.z.datatype == kFloat32 &&
         layout.y.offset == layout.x.offset + sizeof(float) && layout.z.offset == layout.y.offset + sizeof(float);
}

}  // namespace

void cloudFromLayout(const PointCloud2Layout& layout, Cloud& cloud)
{
  if (layout.width == 0 || layout.height == 0) {
    cloud.reset(0, 0);
    return;
  }
  check(layout);
  const std::size_t points = std::size_t{layout.width} * layout.height;
  cloud.width = layout.width;
  cloud.height = layout.height;
  cloud.x.resize(points);
  cloud.y.resize(points);
  cloud.z.resize(points);
  const bool consecutive = areConsecutiveFloats(layout);
  const std::uint64_t step = rowStep(layout, layout.data_size);
  for (std::size_t row = 0; row < layout.height; ++row) {
    const std::uint8_t* data = layout.data + row * step;
    float *const x = &cloud.x[row * layout.width], *const y = &cloud.y[row * layout.width],
                 *const z = &cloud.z[row * layout.width];
    if (consecutive) {
      splitPoints(data + layout.x.offset, layout.point_step, layout.width, x, y, z);
    } else {
      copyRow(data, layout, layout.x, x);
      copyRow(data, layout, layout.y, y);
      copyRow(data, layout, layout.z, z);
    }
    blankUnmeasured(x, y, z, layout.width);
  }
}

}  // namespace grasp_affordances
