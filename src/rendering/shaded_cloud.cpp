#include "rendering/shaded_cloud.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr Color kBackground{0.11F, 0.12F, 0.14F};
constexpr Color kGrey{0.78F, 0.78F, 0.78F};
constexpr float kSaturation = 0.45F;    // share of a point's color that is kept
constexpr float kSameSurface = 0.015F;  // largest relative difference in depth of neighboring pixels on one surface

/// Depth and color per pixel. Each point is drawn as a square; the squares are large enough to overlap in sparse
/// clouds.
class Raster
{
public:
  Raster(const PictureCamera& camera, int splat_radius)
      : depth(std::size_t{camera.width} * camera.height, std::numeric_limits<float>::quiet_NaN()),
        color(depth.size(), kGrey),
        camera_(camera),
        splat_radius_(splat_radius)
  {
  }

  void add(const Eigen::Vector3d& point, const Color& point_color)
  {
    const auto pixel = camera_.project(point);
    if (!pixel || !(pixel->cwiseAbs().maxCoeff() < 1e6)) {
      return;
    }
    const int column = static_cast<int>(std::lround(pixel->x()));
    const int row = static_cast<int>(std::lround(pixel->y()));
    const auto z = static_cast<float>(point.z());
    for (int v = std::max(row - splat_radius_, 0); v <= std::min(row + splat_radius_, height() - 1); ++v) {
      for (int u = std::max(column - splat_radius_, 0); u <= std::min(column + splat_radius_, width() - 1); ++u) {
        const std::size_t i = index(u, v);
        if (!(depth[i] <= z)) {
          depth[i] = z;
          color[i] = point_color;
        }
      }
    }
  }

  int width() const { return static_cast<int>(camera_.width); }
  int height() const { return static_cast<int>(camera_.height); }
  std::size_t index(int u, int v) const
  {
    return static_cast<std::size_t>(v) * camera_.width + static_cast<std::size_t>(u);
  }

  std::vector<float> depth;  // NaN where there is nothing
  std::vector<Color> color;

private:
  const PictureCamera& camera_;
  int splat_radius_;
};

/// For each pixel, the mean depth of the pixels around it on the same surface. Without it the sensor's noise would
/// dominate the shading.
std::vector<float> smoothed(const Raster& raster)
{
  constexpr int kRadius = 4;
  std::vector<float> result(raster.depth);
  for (int v = 0; v < raster.height(); ++v) {
    for (int u = 0; u < raster.width(); ++u) {
      const float center = raster.depth[raster.index(u, v)];
      float sum = 0.0F;
      int count = 0;
      for (int y = std::max(v - kRadius, 0); y <= std::min(v + kRadius, raster.height() - 1); ++y) {
        for (int x = std::max(u - kRadius, 0); x <= std::min(u + kRadius, raster.width() - 1); ++x) {
          const float depth = raster.depth[raster.index(x, y)];
          if (std::abs(depth - center) < kSameSurface * center) {
            sum += depth;
            ++count;
          }
        }
      }
      if (count > 0) {
        result[raster.index(u, v)] = sum / static_cast<float>(count);
      }
    }
  }
  return result;
}

/// Brightness of a pixel, for a light beside the camera. The surface's tangents follow from the neighboring pixels.
class Light
{
public:
  Light(const Raster& raster, const PictureCamera& camera) : raster_(raster), camera_(camera), depth_(smoothed(raster))
  {
  }

  float operator()(int u, int v) const
  {
    const Eigen::Vector3f along_row = tangent(u, v, 1, 0);
    const Eigen::Vector3f along_column = tangent(u, v, 0, 1);
    const Eigen::Vector3f normal = along_column.cross(along_row);
    if (!(normal.norm() > 0.0F)) {
      return 0.55F;
    }
    static const Eigen::Vector3f kToLight = Eigen::Vector3f(-0.45F, -0.6F, -1.0F).normalized();
    const float cosine = normal.normalized().dot(kToLight);
    return 0.25F + 0.75F * std::max(0.0F, cosine);
  }

private:
  Eigen::Vector3f point(int u, int v) const
  {
    const float z = depth_[raster_.index(u, v)];
    const auto& k = camera_.intrinsics;
    return {z * static_cast<float>((u - k.cx) / k.fx), z * static_cast<float>((v - k.cy) / k.fy), z};
  }

  /// Difference between the outermost points on the same surface, up to three pixels to either side; zero if there are
  /// none.
  Eigen::Vector3f tangent(int u, int v, int du, int dv) const
  {
    Eigen::Vector3f ends[2];
    for (int side = 0; side < 2; ++side) {
      ends[side] = point(u, v);
      for (int step = 3; step > 0; --step) {
        const int x = u + (side == 0 ? -step : step) * du;
        const int y = v + (side == 0 ? -step : step) * dv;
        if (x < 0 || y < 0 || x >= raster_.width() || y >= raster_.height()) {
          continue;
        }
        const Eigen::Vector3f neighbor = point(x, y);
        if (std::abs(neighbor.z() - ends[side].z()) < kSameSurface * ends[side].z()) {
          ends[side] = neighbor;
          break;
        }
      }
    }
    return ends[1] - ends[0];
  }

  const Raster& raster_;
  const PictureCamera& camera_;
  std::vector<float> depth_;
};

Color desaturated(const Color& color)
{
  const float grey = 0.3F * color.r + 0.59F * color.g + 0.11F * color.b;
  const auto mix = [grey](float component) { return 0.15F + 0.85F * (grey + kSaturation * (component - grey)); };
  return {mix(color.r), mix(color.g), mix(color.b)};
}

/// Half the side of the squares, in pixels, such that so many points look like closed surfaces.
int splatRadius(const Cloud& cloud, const PictureCamera& camera)
{
  if (camera.is_sensor) {
    return 0;
  }
  const double pixels_per_point =
      static_cast<double>(camera.width) * camera.height / static_cast<double>(std::max<std::size_t>(cloud.size(), 1));
  return std::clamp(static_cast<int>(std::lround(0.6 * std::sqrt(pixels_per_point))), 1, 4);
}

}  // namespace

ShadedCloud shade(const Cloud& cloud, const std::vector<Color>& colors, const PictureCamera& camera)
{
  const bool colored = colors.size() == cloud.size() && !colors.empty();
  Raster raster(camera, splatRadius(cloud, camera));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.measured(i)) {
      raster.add(camera.camera_from_cloud * cloud.point(i).cast<double>(), colored ? desaturated(colors[i]) : kGrey);
    }
  }
  ShadedCloud shaded;
  shaded.pixels.assign(raster.depth.size(), kBackground);
  const Light light(raster, camera);
  for (int v = 0; v < raster.height(); ++v) {
    for (int u = 0; u < raster.width(); ++u) {
      const std::size_t i = raster.index(u, v);
      if (!std::isnan(raster.depth[i])) {
        const float brightness = light(u, v);
        const Color& color = raster.color[i];
        shaded.pixels[i] = {brightness * color.r, brightness * color.g, brightness * color.b};
      }
    }
  }
  shaded.depth = std::move(raster.depth);
  return shaded;
}

}  // namespace grasp_affordances
