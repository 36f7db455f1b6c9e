#pragma once

#include "grasp_affordances/cloud.h"

#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace grasp_affordances
{

/// Says that a cloud, or a file of clouds, cannot be read. what() is one line with the reason.
class CloudError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Number of points of the largest cloud that is read, 4096 x 4096. Working memory grows with the number of points: by
/// some 50 bytes for each, and by up to 130 bytes more for each thread.
constexpr std::uint32_t kMostPoints = 1U << 24U;

/// Where a PointCloud2 says that it keeps its coordinates. Nothing in here has been checked.
struct PointCloud2Layout
{
  struct Coordinate
  {
    bool present = false;
    std::uint8_t datatype = 0;  ///< as in sensor_msgs/PointField
    std::uint32_t count = 0;
    std::uint32_t offset = 0;  ///< bytes from the start of the point
  };

  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t point_step = 0;  ///< bytes
  std::uint32_t row_step = 0;    ///< bytes
  bool big_endian = false;
  Coordinate x, y, z;
  const std::uint8_t* data = nullptr;
  std::size_t data_size = 0;  ///< bytes
};

/// Bytes from the start of a row to that of the next one. Where the data is exactly width x height x point_step, rows
/// follow one another: row_step can then say nothing else, and what drivers write there is often wrong.
/// @param cloud  a PointCloud2 message, or a PointCloud2Layout; its row_step need not fit the rest of it
/// @param data_size  of its data, bytes
template <class PointCloud2>
std::uint64_t rowStep(const PointCloud2& cloud, std::size_t data_size)
{
  const std::uint64_t row = std::uint64_t{cloud.width} * cloud.point_step;
  const bool exact = row > 0 && data_size % row == 0 && data_size / row == cloud.height;
  return exact ? row : cloud.row_step;
}

/// Copies the points; points that are not measured become NaN. Rows may be padded and coordinates unaligned. A width or
/// height of zero makes an empty cloud, whatever the rest of the layout says. A wrong row_step is no error where the
/// data is exactly width x height x point_step.
/// @throw CloudError for a layout that contradicts itself, that lacks x, y or z of FLOAT32 or FLOAT64, or that has more
/// than kMostPoints. Nothing has been allocated then, and the cloud is as it was.
void cloudFromLayout(const PointCloud2Layout& layout, Cloud& cloud);

/// Reads the points of a sensor_msgs::PointCloud2 or a pcl::PCLPointCloud2 into a cloud, whose sensor origin and
/// intrinsics stay as they are. Allocates nothing when the cloud has held as many points before.
/// @throw CloudError as cloudFromLayout.
template <class PointCloud2>
void cloudFromPointCloud2(const PointCloud2& message, Cloud& cloud)
{
  const auto coordinate = [&message](const char* name) {
    PointCloud2Layout::Coordinate found;
    for (const auto& field : message.fields) {
      if (field.name == name) {
        found = {true, field.datatype, static_cast<std::uint32_t>(field.count),
                 static_cast<std::uint32_t>(field.offset)};
        break;
      }
    }
    return found;
  };
  PointCloud2Layout layout;
  layout.width = message.width;
  layout.height = message.height;
  layout.point_step = message.point_step;
  layout.row_step = message.row_step;
  layout.big_endian = message.is_bigendian != 0;
  layout.x = coordinate("x");
  layout.y = coordinate("y");
  layout.z = coordinate("z");
  layout.data = message.data.data();
  layout.data_size = message.data.size();
  cloudFromLayout(layout, cloud);
}

}  // namespace grasp_affordances
