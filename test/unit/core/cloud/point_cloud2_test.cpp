#include "grasp_affordances/point_cloud2.h"

#include "support/allocations.h"

#include <gtest/gtest.h>
#include <pcl/PCLPointCloud2.h>
#include <sensor_msgs/PointCloud2.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <string>

namespace grasp_affordances
{
namespace
{

constexpr std::uint8_t kInt32 = 5, kFloat32 = 7, kFloat64 = 8;
const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInfinity = std::numeric_limits<float>::infinity();

/// 3 x 2 points, the coordinates unaligned and out of order among other bytes, the rows padded.
template <class PointCloud2, typename Coordinate = float>
PointCloud2 makeMessage()
{
  PointCloud2 message;
  message.width = 3;
  message.height = 2;
  message.point_step = 3 + 3 * sizeof(Coordinate) + 2;
  message.row_step = message.width * message.point_step + 7;
  message.data.assign(message.height * message.row_step, 0xEE);
  const char* names[] = {"z", "x", "y"};
  for (std::uint32_t i = 0; i < 3; ++i) {
    typename decltype(message.fields)::value_type field;
    field.name = names[i];
    field.offset = 3 + i * sizeof(Coordinate);
    field.datatype = sizeof(Coordinate) == 4 ? kFloat32 : kFloat64;
    field.count = 1;
    message.fields.push_back(field);
  }
  return message;
}

template <class PointCloud2, typename Coordinate>
void setPoint(PointCloud2& message, std::size_t row, std::size_t column, Coordinate x, Coordinate y, Coordinate z)
{
  const Coordinate zxy[] = {z, x, y};
  std::memcpy(&message.data[row * message.row_step + column * message.point_step + 3], zxy, sizeof(zxy));
}

template <class PointCloud2>
class PointCloud2Test : public testing::Test
{
};
using Messages = testing::Types<sensor_msgs::PointCloud2, pcl::PCLPointCloud2>;
TYPED_TEST_SUITE(PointCloud2Test, Messages);

TYPED_TEST(PointCloud2Test, readsUnalignedFieldsInPaddedRows)
{
  auto message = makeMessage<TypeParam>();
  for (std::size_t i = 0; i < 6; ++i) {
    setPoint(message, i / 3, i % 3, 1.0F + i, 10.0F + i, 100.0F + i);
  }
  Cloud cloud;
  cloudFromPointCloud2(message, cloud);
  EXPECT_EQ(cloud.width, 3U);
  EXPECT_EQ(cloud.height, 2U);
  ASSERT_EQ(cloud.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(cloud.point(i), Eigen::Vector3f(1.0F + i, 10.0F + i, 100.0F + i)) << "point " << i;
  }
}

TYPED_TEST(PointCloud2Test, readsDoubles)
{
  auto message = makeMessage<TypeParam, double>();
  for (std::size_t i = 0; i < 6; ++i) {
    setPoint(message, i / 3, i % 3, 0.1 + i, 0.2 + i, 0.3 + i);
  }
  setPoint(message, 1, 1, 1e300, 0.0, 1.0);  // not finite as a float
  Cloud cloud;
  cloudFromPointCloud2(message, cloud);
  EXPECT_EQ(cloud.point(2), Eigen::Vector3f(2.1F, 2.2F, 2.3F));
  EXPECT_FALSE(cloud.measured(4));
}

TYPED_TEST(PointCloud2Test, readsMixedTypes)
{
  auto message = makeMessage<TypeParam, double>();
  setPoint(message, 0, 0, 1.5, 2.5, 3.5);
  message.fields[0].datatype = kFloat32;  // z
  const float z = 7.5F;
  std::memcpy(&message.data[3], &z, sizeof(z));
  Cloud cloud;
  cloudFromPointCloud2(message, cloud);
  EXPECT_EQ(cloud.point(0), Eigen::Vector3f(1.5F, 2.5F, 7.5F));
}

TYPED_TEST(PointCloud2Test, storesUnmeasuredPointsAsNan)
{
  auto message = makeMessage<TypeParam>();
  setPoint(message, 0, 0, 1.0F, 2.0F, 3.0F);
  setPoint(message, 0, 1, 1.0F, 2.0F, kNan);
  setPoint(message, 0, 2, kInfinity, 2.0F, 3.0F);
  setPoint(message, 1, 0, 0.0F, 0.0F, 0.0F);
  setPoint(message, 1, 1, 1e30F, 0.0F, 1.0F);  // its square overflows
  setPoint(message, 1, 2, 0.1F, 0.2F, -0.3F);  // behind the sensor, but measured
  Cloud cloud;
  cloudFromPointCloud2(message, cloud);
  for (const std::size_t i : {1, 2, 3, 4}) {
    EXPECT_TRUE(cloud.point(i).array().isNaN().all()) << "point " << i;
  }
  EXPECT_EQ(cloud.point(0), Eigen::Vector3f(1.0F, 2.0F, 3.0F));
  EXPECT_EQ(cloud.point(5), Eigen::Vector3f(0.1F, 0.2F, -0.3F));
}

/// The usual layouts: x, y, z in a row, at the start of points of 12, 16, 20 and 32 bytes; also the last in the data.
TYPED_TEST(PointCloud2Test, readsConsecutiveFloats)
{
  for (const std::uint32_t step : {12U, 16U, 20U, 32U}) {
    for (const std::uint32_t padding : {0U, 5U}) {
      auto message = makeMessage<TypeParam>();
      const char* names[] = {"x", "y", "z"};
      for (std::uint32_t i = 0; i < 3; ++i) {
        message.fields[i].name = names[i];
        message.fields[i].offset = step - 12 + 4 * i;
      }
      message.width = 37;
      message.height = 3;
      message.point_step = step;
      message.row_step = 37 * step + padding;
      message.data.assign(std::size_t{3} * message.row_step, 0xEE);
      for (std::size_t i = 0; i < 111; ++i) {
        const float point[] = {1.0F + i, i % 7 == 0 ? kNan : 2.0F, 0.25F * i};
        std::memcpy(&message.data[i / 37 * message.row_step + i % 37 * step + step - 12], point, sizeof(point));
      }
      Cloud cloud;
      cloudFromPointCloud2(message, cloud);
      ASSERT_EQ(cloud.size(), 111U);
      for (std::size_t i = 0; i < 111; ++i) {
        if (i % 7 == 0) {
          EXPECT_TRUE(cloud.point(i).array().isNaN().all()) << "point " << i << ", step " << step;
        } else {
          EXPECT_EQ(cloud.point(i), Eigen::Vector3f(1.0F + i, 2.0F, 0.25F * i)) << "point " << i << ", step " << step;
        }
      }
    }
  }
}

TYPED_TEST(PointCloud2Test, cloudWithoutPointsIsEmpty)
{
  for (const auto& [width, height] : {std::pair{0U, 0U}, {0U, 5U}, {4000000000U, 0U}}) {
    auto message = makeMessage<TypeParam>();
    message.width = width;
    message.height = height;
    message.data.clear();
    Cloud cloud;
    cloud.reset(2, 2);
    cloudFromPointCloud2(message, cloud);
    EXPECT_EQ(cloud.size(), 0U);
    EXPECT_FALSE(cloud.organized());
  }
}

TYPED_TEST(PointCloud2Test, toleratesCountZero)
{
  auto message = makeMessage<TypeParam>();
  setPoint(message, 0, 0, 1.0F, 2.0F, 3.0F);
  message.fields[1].count = 0;
  Cloud cloud;
  cloudFromPointCloud2(message, cloud);
  EXPECT_EQ(cloud.point(0), Eigen::Vector3f(1.0F, 2.0F, 3.0F));
}

TYPED_TEST(PointCloud2Test, keepsSensorAndAllocatesNothingForTheSameSize)
{
  const auto message = makeMessage<TypeParam>();
  Cloud cloud;
  cloud.sensor_origin = Eigen::Vector3f(1.0F, 2.0F, 3.0F);
  cloud.intrinsics = PinholeIntrinsics{525.0, 525.0, 319.5, 239.5};
  cloudFromPointCloud2(message, cloud);
  const std::size_t before = test::allocations;
  cloudFromPointCloud2(message, cloud);
  EXPECT_EQ(test::allocations - before, 0U);
  EXPECT_EQ(cloud.sensor_origin.value(), Eigen::Vector3f(1.0F, 2.0F, 3.0F));
  EXPECT_TRUE(cloud.intrinsics.has_value());
}

/// Drivers, and tools that crop a cloud, leave row_step as it was, at 0, or at the step of a point.
TYPED_TEST(PointCloud2Test, toleratesAWrongRowStepWhereTheDataIsExact)
{
  for (const std::uint32_t height : {1U, 2U}) {
    auto good = makeMessage<TypeParam>();
    good.height = height;
    good.row_step = 3 * good.point_step;
    good.data.assign(std::size_t{height} * good.row_step, 0xEE);
    for (std::size_t i = 0; i < std::size_t{3} * height; ++i) {
      setPoint(good, i / 3, i % 3, 1.0F + i, 10.0F + i, 100.0F + i);
    }
    for (const std::uint32_t step :
         {0U, 1U, good.point_step, 640 * good.point_step, std::numeric_limits<std::uint32_t>::max()}) {
      SCOPED_TRACE(step);
      auto message = good;
      message.row_step = step;
      Cloud cloud;
      cloudFromPointCloud2(message, cloud);
      EXPECT_EQ(cloud.height, height);
      const std::size_t points = std::size_t{3} * height;
      ASSERT_EQ(cloud.size(), points);
      for (std::size_t i = 0; i < points; ++i) {
        EXPECT_EQ(cloud.point(i), Eigen::Vector3f(1.0F + i, 10.0F + i, 100.0F + i)) << "point " << i;
      }
      message.data.push_back(0);
      EXPECT_THROW(cloudFromPointCloud2(message, cloud), CloudError) << "the data is not exact";
    }
  }
}

/// A message that one change has made contradict itself.
template <class PointCloud2>
struct Malformed
{
  std::function<void(PointCloud2&)> change;
  std::string reason;  // part of the error
};

TYPED_TEST(PointCloud2Test, refusesMalformedMessagesAndLeavesTheCloudAlone)
{
  using M = TypeParam;
  const std::vector<Malformed<M>> cases{
      {[](M& m) { m.fields[1].name = "intensity"; }, "no field x"},
      {[](M& m) { m.fields[2].name = "Y"; }, "no field y"},
      {[](M& m) { m.fields.erase(m.fields.begin()); }, "no field z"},
      {[](M& m) { m.fields.clear(); }, "no field x"},
      {[](M& m) { m.fields[0].datatype = kInt32; }, "field z has datatype 5"},
      {[](M& m) { m.fields[0].datatype = 0; }, "datatype 0"},
      {[](M& m) { m.fields[2].count = 3; }, "3 values"},
      {[](M& m) { m.is_bigendian = 1; }, "big-endian"},
      {[](M& m) { m.fields[0].offset = m.point_step - 3; }, "outside the point_step"},
      {[](M& m) { m.fields[0].offset = std::numeric_limits<std::uint32_t>::max() - 1; }, "outside the point_step"},
      {[](M& m) { m.point_step = 0; }, "outside the point_step"},
      {[](M& m) { m.point_step = std::numeric_limits<std::uint32_t>::max(); }, "row_step"},
      {[](M& m) { m.row_step = 3 * m.point_step - 1; }, "row_step"},
      {[](M& m) { m.row_step = 0; }, "row_step"},
      {[](M& m) { m.row_step += 1; }, "data holds"},
      {[](M& m) { m.data.pop_back(); }, "data holds"},
      {[](M& m) { m.data.push_back(0); }, "data holds"},
      {[](M& m) { m.data.clear(); }, "data holds"},
      {[](M& m) { m.height = 3; }, "data holds"},
      {[](M& m) { m.height = 4000000000U; }, "data holds"},
      {[](M& m) { m.width = 4000000000U; }, "row_step"},
      {[](M& m) {  // in 32 bit: width * point_step = 0 and height * row_step = 0
         m.width = 1U << 31;
         m.point_step = 18;
         m.row_step = 0;
         m.data.clear();
       },
       "row_step"},
      {[](M& m) {
         m.height = 1U << 31;
         m.row_step = 128;
         m.data.clear();
       },
       "data holds"},
      {[](M& m) {  // in 64 bit: width * height * point_step = 0
         m.width = 1U << 31;
         m.height = 1U << 31;
         m.point_step = 32;
         m.row_step = 0;
         m.data.clear();
       },
       "row_step"},
  };
  for (const auto& malformed : cases) {
    auto message = makeMessage<M>();
    malformed.change(message);
    Cloud cloud;
    cloud.reset(1, 1);
    cloud.set(0, 1.0F, 2.0F, 3.0F);
    try {
      cloudFromPointCloud2(message, cloud);
      ADD_FAILURE() << "accepted: " << malformed.reason;
    } catch (const CloudError& error) {
      EXPECT_NE(std::string(error.what()).find(malformed.reason), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
    EXPECT_EQ(cloud.size(), 1U);
    EXPECT_EQ(cloud.point(0), Eigen::Vector3f(1.0F, 2.0F, 3.0F));
  }
}

}  // namespace
}  // namespace grasp_affordances
