#include "virtual_device/color_image.h"

#include "simulation/disparity_image.h"
#include "simulation/visible_surfaces.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace grasp_affordances
{
namespace
{

using Rgb = std::array<double, 3>;

constexpr std::array<Rgb, 8> kObjectColors = {{{178, 168, 150},
                                               {86, 180, 233},
                                               {230, 159, 0},
                                               {0, 158, 115},
                                               {240, 228, 66},
                                               {204, 121, 167},
                                               {213, 94, 0},
                                               {90, 110, 200}}};

}  // namespace

std::vector<std::uint8_t> colorImage(const View& view, const PinholeIntrinsics& camera, std::uint32_t width,
                                     std::uint32_t height)
{
  constexpr double ambient = 0.3;
  const VisibleSurfaces visible = findVisibleSurfaces(view.scene, view.T_scene_camera, camera, width, height);
  SurfaceImage nearest = visible.opaque;
  for (std::size_t i = 0; i < nearest.depth.size(); ++i) {
    if (visible.transparent.depth[i] < nearest.depth[i]) {
      nearest.depth[i] = visible.transparent.depth[i];
      nearest.part[i] = visible.transparent.part[i];
    }
  }
  // Normals come from ratios of disparities, so that the value of the baseline does not matter.
  const DisparityImage disparity(nearest.depth, static_cast<int>(width), static_cast<int>(height), camera, 1.0);

  std::vector<std::uint8_t> image(3 * nearest.depth.size(), 0);
  for (int row = 0; row < static_cast<int>(height); ++row) {
    for (int column = 0; column < static_cast<int>(width); ++column) {
      const std::size_t i = disparity.index({column, row});
      if (nearest.part[i] < 0)
        continue;
      const Rgb& color = kObjectColors[view.scene.parts()[nearest.part[i]].object % kObjectColors.size()];
      const Eigen::Vector3d normal = disparity.normal({column, row}).normalized();
      const double lit = std::abs(normal.dot(disparity.ray({column, row}).normalized()));
      for (std::size_t channel = 0; channel < 3; ++channel)
        image[3 * i + channel] = static_cast<std::uint8_t>(color[channel] * (ambient + (1.0 - ambient) * lit));
    }
  }
  return image;
}

}  // namespace grasp_affordances
