#include "simulation/projector_shadow.h"
#include "simulation/ray_caster.h"
#include "simulation/scene_library.h"
#include "simulation/sensor.h"
#include "simulation/visible_surfaces.h"
#include "support/sensor_views.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace grasp_affordances
{
namespace
{

using namespace test;

TEST(RayCaster, FindsWhatAllPartsOneByOneGive)
{
  const View view = makeScene("table", 3);
  const RayCaster caster(view.scene, view.T_scene_camera);
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> slope(-0.7, 0.7);
  for (int trial = 0; trial < 20000; ++trial) {
    const Eigen::Vector3d direction(slope(engine), slope(engine), 1.0);
    Hit nearest{kNoIntersection, nullptr};
    for (const Part& part : view.scene.parts()) {
      const Eigen::Isometry3d T_shape_camera = part.T_scene_shape.inverse() * view.T_scene_camera;
      const double t = intersect(part.shape, {T_shape_camera.translation(), T_shape_camera.linear() * direction});
      if (t < nearest.t)
        nearest = {t, &part};
    }
    const std::optional<Hit> hit = caster.cast(direction);
    ASSERT_EQ(hit.has_value(), nearest.part != nullptr);
    if (hit) {
      ASSERT_EQ(hit->part, nearest.part);
      ASSERT_NEAR(hit->t, nearest.t, 1e-12);
    }
  }
}

TEST(VisibleSurfaces, AreThoseOfAllPartsOneByOne)
{
  const View view = allKinds();
  const SensorModel model;
  // The camera is elsewhere, and rolled.
  const Eigen::Isometry3d T_scene_camera =
      at(0.02, -0.05, 0.1) * Eigen::AngleAxisd(0.2, Eigen::Vector3d(0.2, 0.1, 1.0).normalized());
  const VisibleSurfaces visible =
      findVisibleSurfaces(view.scene, T_scene_camera, model.intrinsics, model.width, model.height);
  std::vector<std::size_t> seen(view.scene.parts().size(), 0);
  for (std::size_t pixel = 0; pixel < visible.opaque.depth.size(); ++pixel) {
    const std::size_t u = pixel % model.width, v = pixel / model.width;
    const Eigen::Vector3d direction((static_cast<double>(u) - model.intrinsics.cx) / model.intrinsics.fx,
                                    (static_cast<double>(v) - model.intrinsics.cy) / model.intrinsics.fy, 1.0);
    double nearest[2] = {kNoIntersection, kNoIntersection};
    std::int32_t part[2] = {-1, -1};
    for (std::size_t k = 0; k < view.scene.parts().size(); ++k) {
      const Part& candidate = view.scene.parts()[k];
      const Eigen::Isometry3d T_shape_camera = candidate.T_scene_shape.inverse() * T_scene_camera;
      const double t = intersect(candidate.shape, {T_shape_camera.translation(), T_shape_camera.linear() * direction});
      const int layer = candidate.surface == Surface::transparent ? 1 : 0;
      if (t < nearest[layer]) {
        nearest[layer] = t;
        part[layer] = static_cast<std::int32_t>(k);
      }
    }
    for (const int layer : {0, 1}) {
      const SurfaceImage& image = layer == 0 ? visible.opaque : visible.transparent;
      if (part[layer] < 0) {
        ASSERT_EQ(image.part[pixel], -1) << "pixel " << pixel;
        ASSERT_EQ(image.depth[pixel], std::numeric_limits<float>::infinity());
        continue;
      }
      ASSERT_NEAR(image.depth[pixel], nearest[layer], 2e-7 * nearest[layer]) << "pixel " << pixel;
      ASSERT_EQ(image.part[pixel], part[layer]) << "pixel " << pixel;
      ++seen[part[layer]];
    }
  }
  for (std::size_t k = 0; k < seen.size(); ++k)
    EXPECT_GT(seen[k], 300u) << "part " << k;
}

TEST(ProjectorShadow, OfAPlateIsAsWideAsTheDifferenceOfDisparities)
{
  constexpr int width = 200;
  for (const float difference : {0.0F, 0.9F, 1.4F, 7.0F, 21.7F, 40.0F}) {
    std::vector<float> disparity(width, 30.0F);
    std::fill(disparity.begin() + 100, disparity.begin() + 150, 30.0F + difference);
    std::vector<std::uint8_t> shadowed(width);
    findProjectorShadow(disparity.data(), disparity.data(), width, shadowed.data());
    // Left of the plate, from its edge half a pixel beyond its first column.
    for (int u = 0; u < width; ++u) {
      const bool expected = difference >= 1.0F && u < 100 && static_cast<float>(u) >= 99.5F - difference;
      EXPECT_EQ(shadowed[u], expected ? 1 : 0) << "column " << u << ", difference " << difference;
    }
  }
}

// A pole that is slimmer than the displacement of its shadow: the wall between both is lit. And a step without
// surface, as of glass, throws none.
TEST(ProjectorShadow, OfASlimPoleIsApartFromIt)
{
  constexpr int width = 200;
  std::vector<float> disparity(width, 30.0F);
  std::fill(disparity.begin() + 100, disparity.begin() + 105, 50.0F);
  std::vector<std::uint8_t> shadowed(width);
  findProjectorShadow(disparity.data(), disparity.data(), width, shadowed.data());
  for (int u = 0; u < width; ++u)
    EXPECT_EQ(shadowed[u], u >= 80 && u < 85 ? 1 : 0) << "column " << u;

  const std::vector<float> behind(width, 30.0F);
  findProjectorShadow(disparity.data(), behind.data(), width, shadowed.data());
  EXPECT_EQ(std::count(shadowed.begin(), shadowed.end(), 1), 0);
}

// Surfaces do not shade themselves, however slanted, up to the slope at which they turn away from the projector.
TEST(ProjectorShadow, IsNotOnSlantedPlanes)
{
  constexpr int width = 100;
  for (const float slope : {-3.0F, -0.95F, -0.3F, 0.3F, 0.95F}) {
    std::vector<float> disparity(width);
    for (int u = 0; u < width; ++u)
      disparity[u] = 350.0F + slope * static_cast<float>(u - 50);
    std::vector<std::uint8_t> shadowed(width);
    findProjectorShadow(disparity.data(), disparity.data(), width, shadowed.data());
    EXPECT_EQ(std::count(shadowed.begin(), shadowed.end(), 1), 0) << "slope " << slope;
  }
}

}  // namespace
}  // namespace grasp_affordances
