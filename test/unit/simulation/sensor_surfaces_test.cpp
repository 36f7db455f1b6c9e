#include "simulation/sensor.h"
#include "support/sensor_views.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace grasp_affordances
{
namespace
{

using namespace test;

TEST(DepthCamera, LosesSurfacesAtGrazingAngles)
{
  constexpr int bins = 90;
  std::vector<double> pixels(bins, 0.0), found(bins, 0.0);
  for (const double tilt : {55.0, 65.0, 75.0, 80.0, 85.0}) {
    const Frame frame = capture(wall(1.0, tilt * kDegree, Eigen::Vector3d::UnitX()), 1);
    const Eigen::Vector3d normal(0.0, std::sin(tilt * kDegree), -std::cos(tilt * kDegree));
    const SensorModel model;
    for (std::size_t i = 0; i < frame.depth.size(); ++i) {
      const std::size_t u = i % 640, v = i / 640;
      const Eigen::Vector3d ray((static_cast<double>(u) - model.intrinsics.cx) / model.intrinsics.fx,
                                (static_cast<double>(v) - model.intrinsics.cy) / model.intrinsics.fy, 1.0);
      const double depth = normal.z() / normal.dot(ray);
      if (!(depth > 0.6 && depth < 3.0))
        continue;
      const double incidence = std::acos(std::abs(normal.dot(ray)) / ray.norm()) / kDegree;
      pixels[static_cast<int>(incidence)] += 1.0;
      found[static_cast<int>(incidence)] += frame.depth[i] != 0 ? 1.0 : 0.0;
    }
  }
  for (int angle = 0; angle < bins; ++angle) {
    if (pixels[angle] < 3000.0)
      continue;
    const double share = found[angle] / pixels[angle];
    SCOPED_TRACE(std::to_string(angle) + " degrees");
    if (angle < 65) {
      EXPECT_EQ(share, 1.0);
    } else if (angle < 70) {
      EXPECT_GT(share, 0.95);
    } else if (angle == 75 || angle == 76) {
      EXPECT_NEAR(share, 0.5, 0.25);
    } else if (angle >= 84) {
      EXPECT_LT(share, 0.01);
    }
  }
  EXPECT_GT(pixels[60], 3000.0);
  EXPECT_GT(pixels[75], 3000.0);
  EXPECT_GT(pixels[85], 3000.0);
}

TEST(DepthCamera, DarkSurfacesFadeWithDistanceAndSlant)
{
  const auto share = [](double depth, double tilt) {
    return measuredShare(capture(wall(depth, tilt * kDegree, Eigen::Vector3d::UnitX(), Surface::dark), 1));
  };
  EXPECT_GT(share(0.6, 0.0), 0.99);
  EXPECT_NEAR(share(1.1, 0.0), 0.45, 0.15);  // half of it in the middle, less towards the borders
  EXPECT_LT(share(2.0, 0.0), 0.1);
  EXPECT_LT(share(0.9, 50.0), share(0.9, 0.0) - 0.2);
}

TEST(DepthCamera, ShinySurfacesHaveAHoleWhereTheyMirrorTheProjector)
{
  const Frame frame = capture(wall(1.0, 0.0, Eigen::Vector3d::UnitY(), Surface::shiny), 1);
  // The mirror's normal is half-way between camera and projector: 3.75 cm to the right.
  const auto shareWithin = [&](double least, double most) {
    double pixels = 0.0, found = 0.0;
    for (std::size_t i = 0; i < frame.depth.size(); ++i) {
      const std::size_t u = i % 640, v = i / 640;
      const double x = (static_cast<double>(u) - 319.5) / 575.8 - 0.0375;
      const double y = (static_cast<double>(v) - 239.5) / 575.8;
      const double sine = std::hypot(x, y) / std::hypot(x, y, 1.0);
      if (sine < least || sine >= most)
        continue;
      pixels += 1.0;
      found += frame.depth[i] != 0 ? 1.0 : 0.0;
    }
    return found / pixels;
  };
  EXPECT_LT(shareWithin(0.0, 0.08), 0.05);
  EXPECT_NEAR(shareWithin(0.3, 0.6), 0.9, 0.04);
}

TEST(DepthCamera, SeesThroughTransparentSurfaces)
{
  View view = wall(1.2);
  view.scene.add(Box{{2.0, 2.0, 0.005}}, at(0.0, 0.0, 0.8), Surface::transparent);
  const Frame frame = capture(view, 1);
  EXPECT_NEAR(shareOfPart(frame, 0), 0.73, 0.08);
  EXPECT_NEAR(shareOfPart(frame, 1), 0.07, 0.04);
  EXPECT_EQ(shareOfPart(capture(view, 1, exactModel()), 1), 1.0);
}

TEST(DepthCamera, AbsorbingSurfacesHideWhatIsBehindThem)
{
  View view = wall(1.2);
  view.scene.add(Box{{2.0, 2.0, 0.005}}, at(0.0, 0.0, 0.8), Surface::absorbing);
  for (const SensorModel& model : {SensorModel(), exactModel()})
    EXPECT_EQ(measured(capture(view, 1, model)), 0u);
}

}  // namespace
}  // namespace grasp_affordances
