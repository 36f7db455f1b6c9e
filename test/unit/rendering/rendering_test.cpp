#include "rendering/color.h"
#include "rendering/label_place.h"
#include "rendering/picture.h"
#include "rendering/picture_camera.h"
#include "support/points.h"
#include "support/test_with_folder.h"

#include <cairo.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances
{
namespace
{

constexpr double kDepth = 1.0;  // m, of the wall

/// A wall at right angles to the optical axis, seen by a camera of 160 x 120 pixels.
Cloud makeWall()
{
  const PinholeIntrinsics k{130.0, 130.0, 79.5, 59.5};
  Cloud cloud;
  cloud.reset(160, 120);
  for (std::uint32_t v = 0, i = 0; v < cloud.height; ++v) {
    for (std::uint32_t u = 0; u < cloud.width; ++u, ++i) {
      cloud.set(i, (u - k.cx) / k.fx * kDepth, (v - k.cy) / k.fy * kDepth, kDepth);
    }
  }
  return cloud;
}

/// Before the wall, upright.
Shell makeShell()
{
  Shell shell;
  shell.centroid = {0.1, 0.05, 0.8};
  shell.axis = Eigen::Vector3d::UnitY();
  shell.normal = -Eigen::Vector3d::UnitZ();
  shell.inner_radius = 0.05;
  shell.thickness = 0.02;
  shell.length = 0.2;
  return shell;
}

/// A PNG file, read back.
class Image
{
public:
  explicit Image(const std::string& path)
      : surface_(cairo_image_surface_create_from_png(path.c_str()), cairo_surface_destroy)
  {
    EXPECT_EQ(cairo_surface_status(surface_.get()), CAIRO_STATUS_SUCCESS) << path;
  }

  int width() const { return cairo_image_surface_get_width(surface_.get()); }
  int height() const { return cairo_image_surface_get_height(surface_.get()); }

  Color at(const Eigen::Vector2d& pixel) const
  {
    const int column = static_cast<int>(pixel.x());
    const int row = static_cast<int>(pixel.y());
    EXPECT_TRUE(column >= 0 && column < width() && row >= 0 && row < height()) << pixel.transpose();
    const unsigned char* data = cairo_image_surface_get_data(surface_.get());
    const unsigned char* bgr = data + row * cairo_image_surface_get_stride(surface_.get()) + 4 * column;
    return {bgr[2] / 255.0F, bgr[1] / 255.0F, bgr[0] / 255.0F};
  }

private:
  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
};

/// How much redder a pixel is than it is green or blue: 0 for grey, 1 for pure red.
float redness(const Color& color)
{
  return color.r - std::max(color.g, color.b);
}

class RenderingTest : public test::TestWithFolder
{
protected:
  Image saved(const Picture& picture) const
  {
    const std::string path = folder_ / "picture.png";
    picture.save(path);
    return Image(path);
  }
};

const ShellStyle kRed{{1.0F, 0.0F, 0.0F}, 1.0, 0.5, 3.0, true};

TEST_F(RenderingTest, cameraOfAnOrganizedCloudIsItsSensor)
{
  const PictureCamera camera = pictureCamera(makeWall());
  EXPECT_TRUE(camera.is_sensor);
  EXPECT_EQ(camera.width, 160U);
  EXPECT_EQ(camera.height, 120U);
  EXPECT_NEAR(camera.intrinsics.fx, 130.0, 1e-3);
  EXPECT_NEAR(camera.intrinsics.cy, 59.5, 1e-3);
  EXPECT_FALSE(camera.project({0.0, 0.0, 0.0}));
  EXPECT_FALSE(camera.project({0.0, 0.0, -1.0}));
}

TEST_F(RenderingTest, cameraOfARangeImageWithABadPointIsItsSensor)
{
  Cloud cloud = makeWall();
  const Eigen::Vector3f p = cloud.point(1000);
  cloud.set(1000, p.x() + 0.2F, p.y(), p.z());
  const PictureCamera camera = pictureCamera(cloud);
  EXPECT_TRUE(camera.is_sensor);
  EXPECT_NEAR(camera.intrinsics.fx, 130.0, 1e-3);
}

TEST_F(RenderingTest, cameraOfAnUnorganizedCloudStandsAtTheSensorAndTakesThePointsIn)
{
  for (const Eigen::Vector3f& offset : {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(3, -2, 1)}) {
    Cloud cloud = test::unorganized(makeWall());
    for (std::size_t i = 0; i < cloud.size(); ++i) {  // turned to look along x
      const Eigen::Vector3f p = cloud.point(i);
      cloud.set(i, p.z() + offset.x(), -p.x() + offset.y(), -p.y() + offset.z());
    }
    cloud.sensor_origin = offset;
    const PictureCamera camera = pictureCamera(cloud);
    EXPECT_FALSE(camera.is_sensor);
    EXPECT_NEAR((camera.camera_from_cloud * offset.cast<double>()).norm(), 0.0, 1e-6);
    std::size_t inside = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const auto pixel = camera.project(camera.camera_from_cloud * cloud.point(i).cast<double>());
      ASSERT_TRUE(pixel);
      inside += pixel->x() > -1 && pixel->x() < camera.width && pixel->y() > -1 && pixel->y() < camera.height;
    }
    EXPECT_GE(inside, 0.95 * cloud.size());
    const auto right =
        camera.project(camera.camera_from_cloud * (offset + Eigen::Vector3f(1, -0.1F, 0)).cast<double>());
    const auto up = camera.project(camera.camera_from_cloud * (offset + Eigen::Vector3f(1, 0, 0.1F)).cast<double>());
    EXPECT_GT(right->x(), camera.intrinsics.cx);
    EXPECT_LT(up->y(), camera.intrinsics.cy);
  }
}

TEST_F(RenderingTest, cameraOfAnObjectModelStandsOutsideIt)
{
  Cloud cloud;
  cloud.reset(1000, 1);
  for (std::size_t i = 0; i < cloud.size(); ++i) {  // a spiral on a cylinder about z, centred on the origin
    const auto s = static_cast<float>(i);
    cloud.set(i, 0.05F * std::cos(s), 0.05F * std::sin(s), 0.0002F * (s - 500.0F));
  }
  const PictureCamera camera = pictureCamera(cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto pixel = camera.project(camera.camera_from_cloud * cloud.point(i).cast<double>());
    ASSERT_TRUE(pixel) << "in front of the camera";
  }
  const auto top = camera.project(camera.camera_from_cloud * Eigen::Vector3d(0.0, 0.0, 0.1));
  const auto bottom = camera.project(camera.camera_from_cloud * Eigen::Vector3d(0.0, 0.0, -0.1));
  EXPECT_LT(top->y(), bottom->y());

  cloud.sensor_origin = Eigen::Vector3f::Zero();
  EXPECT_LT(pictureCamera(cloud).camera_from_cloud.translation().norm(), 1e-9) << "a known place is taken";
}

TEST_F(RenderingTest, drawsAShellWithoutANormalAsWell)
{
  Shell shell = makeShell();
  shell.normal.setConstant(std::nan(""));
  Picture picture(makeWall());
  picture.drawShell(shell, kRed);
  const Image image = saved(picture);
  const auto at = [&](double right, double along) {
    return image.at(*picture.project(shell.centroid + Eigen::Vector3d(right, along, 0.0)));
  };
  EXPECT_GT(redness(at(0.03, 0.02)), 0.2) << "filled inside";
  EXPECT_LT(std::abs(redness(at(0.12, 0.0))), 0.02) << "nothing beside it";
}

TEST_F(RenderingTest, drawsAShellWhereItProjects)
{
  for (const Cloud& cloud : {makeWall(), test::unorganized(makeWall())}) {
    const Shell shell = makeShell();
    Picture picture(cloud);
    picture.drawShell(shell, kRed);
    const Image image = saved(picture);
    EXPECT_EQ(image.width(), picture.width());
    EXPECT_EQ(image.height(), picture.height());
    EXPECT_GE(picture.width(), 1000);

    const auto at = [&](double right, double along) {
      return image.at(*picture.project(shell.centroid + Eigen::Vector3d(right, along, 0.0)));
    };
    EXPECT_GT(redness(at(0.03, 0.02)), 0.2) << "filled inside";
    const Color axis = at(0.0, 0.02);
    EXPECT_GT(std::min({axis.r, axis.g, axis.b}), 0.9) << "white axis";
    EXPECT_LT(std::abs(redness(at(0.12, 0.0))), 0.02) << "nothing beside it";
    EXPECT_LT(std::abs(redness(at(0.0, 0.17))), 0.02) << "nothing below it";
    // The silhouette: rays that touch the cylinder of radius r about an axis at depth z have the slope r / sqrt(z^2 -
    // r^2) from it, seen from straight before it.
    Shell ahead = shell;
    ahead.centroid = {0.0, 0.0, 0.8};
    Picture other(cloud);
    other.drawShell(ahead, kRed);
    const Image silhouette = saved(other);
    const double reach = 0.8 * 0.05 / std::sqrt(0.8 * 0.8 - 0.05 * 0.05);
    EXPECT_GT(redness(silhouette.at(*other.project({reach, 0.0, 0.8}))), 0.8);
    EXPECT_GT(redness(silhouette.at(*other.project({-reach, 0.0, 0.8}))), 0.8);
  }
}

TEST_F(RenderingTest, picturesAWallAsLitAndAHoleAsDark)
{
  Cloud cloud = makeWall();
  for (std::uint32_t v = 40; v < 80; ++v) {
    for (std::uint32_t u = 20; u < 60; ++u) {
      cloud.set(v * cloud.width + u, 0.0F, 0.0F, 0.0F);
    }
  }
  const Picture picture(cloud);
  const Image image = saved(picture);
  const double scale = picture.width() / 160.0;
  EXPECT_GT(image.at({110 * scale, 60 * scale}).g, 0.5F);
  EXPECT_LT(image.at({40 * scale, 60 * scale}).g, 0.2F);
}

TEST_F(RenderingTest, keepsAHintOfTheCloudsColor)
{
  const Cloud cloud = makeWall();
  const Image image = saved(Picture(cloud, std::vector<Color>(cloud.size(), {0.8F, 0.2F, 0.2F})));
  const float red = redness(image.at({300.0, 300.0}));
  EXPECT_GT(red, 0.05F);
  EXPECT_LT(red, 0.4F);
}

/// Before the wall, upright: a straight handle with a hand that comes from the camera's side.
GraspHandle makeHandle(std::uint32_t id, double x)
{
  GraspHandle handle;
  handle.id = id;
  handle.centroid = {x, 0.0, 0.8};
  handle.axis = Eigen::Vector3d::UnitY();
  handle.normal = -Eigen::Vector3d::UnitZ();
  handle.radius = 0.02;
  handle.inner_radius = 0.025;
  handle.length = 0.3;
  handle.polyline = {{x, -0.15, 0.8}, {x, 0.15, 0.8}};
  GraspPose hand;
  hand.pose.linear() << -handle.normal, handle.axis.cross(-handle.normal), handle.axis;
  hand.pose.translation() = handle.centroid;
  hand.width = 0.05;
  handle.hand_poses.push_back(hand);
  return handle;
}

TEST_F(RenderingTest, drawsEachHandleInItsColorWithItsHand)
{
  Localization localization;
  localization.handles = {makeHandle(1, 0.1), makeHandle(2, -0.2)};
  localization.shells.push_back(makeShell());
  localization.handles.front().shells = {0};
  Config config;
  config.hand.finger_thickness = 0.02;
  config.hand.palm_width = 0.06;
  config.hand_poses.tool_x = 0.2;  // the hand is drawn, not its tool
  for (GraspHandle& handle : localization.handles) {
    handle.hand_poses.front().pose.translate(Eigen::Vector3d(0.2, 0.0, 0.0));
  }
  Picture picture(makeWall());
  drawLocalization(picture, localization, config);
  picture.drawCaption("2 handles");
  const Image image = saved(picture);
  const auto at = [&](double x, double y, double z) { return image.at(*picture.project({x, y, z})); };
  EXPECT_GT(at(0.11, 0.12, 0.8).r - at(0.11, 0.12, 0.8).b, 0.1F) << "the tube is orange";
  EXPECT_GT(at(-0.19, 0.12, 0.8).b - at(-0.19, 0.12, 0.8).r, 0.1F) << "cyan";
  for (const double side : {-1.0, 1.0}) {
    const Color finger = at(0.1 + side * 0.037, 0.01, 0.775);
    EXPECT_GT(finger.r - finger.b, 0.1F) << "fingers on both sides of the handle";
    const Color beside = at(0.1 + side * 0.07, 0.01, 0.775);
    EXPECT_LT(std::abs(beside.r - beside.b), 0.02F) << "nothing beyond them";
  }
}

TEST_F(RenderingTest, drawsABentTubeAsOneSilhouette)
{
  const std::vector<Eigen::Vector3d> line{{-0.1, 0.0, 0.8}, {0.0, 0.0, 0.8}, {0.0, 0.1, 0.8}};
  BodyStyle style;
  style.color = kRed.color;
  style.line_width = 4.0;
  style.fill_opacity = 0.5;
  Picture picture(makeWall());
  picture.drawTube(line, 0.02, style);
  const Image image = saved(picture);
  const auto at = [&](double x, double y) { return redness(image.at(*picture.project({x, y, 0.8}))); };
  const float inside = at(-0.06, 0.012);
  EXPECT_GT(inside, 0.3F);
  EXPECT_NEAR(at(0.01, 0.06), inside, 0.05) << "the other arm";
  EXPECT_NEAR(at(-0.008, 0.004), inside, 0.05) << "filled once, and not outlined, where the arms meet";
  EXPECT_LT(at(-0.05, 0.06), 0.02F) << "nothing in the inside of the bend";
}

TEST(LabelPlace, IsBesideTheSubjectWhereNothingIsCovered)
{
  const Rectangle picture(Eigen::Vector2d(0, 0), Eigen::Vector2d(640, 480));
  const Rectangle subject(Eigen::Vector2d(300, 200), Eigen::Vector2d(340, 280));
  const Eigen::Vector2d size(30, 20);
  std::vector<Rectangle> taken{subject};
  for (int i = 0; i < 8; ++i) {
    const Rectangle place = labelPlace(picture, subject, size, taken);
    EXPECT_TRUE(picture.contains(place));
    EXPECT_TRUE(place.sizes().isApprox(size));
    EXPECT_LT(place.exteriorDistance(subject), 20.0);
    for (const Rectangle& other : taken) {
      EXPECT_TRUE(place.intersection(other).isEmpty()) << "label " << i;
    }
    taken.push_back(place);
  }
  const Rectangle at_the_edge(Eigen::Vector2d(600, 200), Eigen::Vector2d(640, 280));
  EXPECT_TRUE(picture.contains(labelPlace(picture, at_the_edge, size, {})));
}

TEST_F(RenderingTest, leavesOutShellsBehindTheCameraAndDrawsCloudsWithoutPoints)
{
  Shell behind = makeShell();
  behind.centroid.z() = 0.02;
  Cloud nothing;
  Cloud unmeasured;
  unmeasured.reset(64, 48);
  for (const Cloud& cloud : {makeWall(), nothing, unmeasured}) {
    Picture picture(cloud);
    picture.drawShell(behind, kRed);
    Localization localization;
    localization.shells = {behind};
    localization.handles = {makeHandle(1, 0.0)};
    localization.handles.front().polyline = {{0.0, 0.0, 0.01}, {0.0, 0.0, -0.1}};
    localization.handles.front().hand_poses.front().pose.translation().z() = -0.1;
    drawLocalization(picture, localization, Config());
    const Image image = saved(picture);
    EXPECT_GT(image.width(), 0);
    EXPECT_LT(std::abs(redness(image.at({0.5 * image.width(), 0.5 * image.height()}))), 0.05);
  }
}

TEST_F(RenderingTest, saysWhyAPictureCannotBeWritten)
{
  const Picture picture(makeWall());
  for (const auto& [path, reason] : {std::pair<std::string, std::string>{folder_ / "no/picture.png", "No such file"},
                                     {folder_, "directory"},
                                     {"/dev/full", "No space left"}}) {
    try {
      picture.save(path);
      ADD_FAILURE() << path;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  }
}

TEST_F(RenderingTest, readsPointColors)
{
  struct Field
  {
    std::string name;
    std::uint32_t offset;
  };
  struct
  {
    std::uint32_t width = 2, height = 1, point_step = 6, row_step = 12;
    std::vector<Field> fields;
    std::vector<std::uint8_t> data{9, 9, 0xFF, 0x80, 0x00, 0, 9, 9, 0x00, 0x00, 0xFF, 0};  // blue, green, red
  } message;
  EXPECT_TRUE(pointColors(message).empty());
  message.fields.resize(1);
  message.fields[0].offset = 2;
  for (const char* name : {"rgb", "rgba"}) {
    message.fields[0].name = name;
    const std::vector<Color> colors = pointColors(message);
    ASSERT_EQ(colors.size(), 2U);
    EXPECT_EQ(colors[0].r, 0.0F);
    EXPECT_NEAR(colors[0].g, 128 / 255.0, 1e-6);
    EXPECT_EQ(colors[0].b, 1.0F);
    EXPECT_EQ(colors[1].r, 1.0F);
  }
  message.width = 1;
  message.height = 2;
  message.row_step = 0xFFFFFF00U;  // wrong, but the data is exact
  const std::vector<Color> column = pointColors(message);
  ASSERT_EQ(column.size(), 2U);
  EXPECT_EQ(column[0].b, 1.0F);
  EXPECT_EQ(column[1].r, 1.0F);
  message.fields[0].offset = 3;
  EXPECT_TRUE(pointColors(message).empty()) << "outside the point";
}

}  // namespace
}  // namespace grasp_affordances
