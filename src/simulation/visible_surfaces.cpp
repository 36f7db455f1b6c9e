#include "simulation/visible_surfaces.h"

#include "simulation/parallel_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace grasp_affordances
{
namespace
{

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Span
{
  double low = kInfinity;
  double high = -kInfinity;

  void include(double value)
  {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// The image area of a solid's bounding box: the convex hull of its projected edges.
class Outline
{
public:
  Outline(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& T_camera_solid, const PinholeIntrinsics& camera)
  {
    constexpr double nearest = 0.001;  // m; for a box that is nearer, or partly behind the camera, every pixel is tried
    std::array<Eigen::Vector2d, 8> corners;
    for (int i = 0; i < 8; ++i) {
      const auto corner = static_cast<Eigen::AlignedBox3d::CornerType>(i);
      const Eigen::Vector3d p = T_camera_solid * box.corner(corner);
      everywhere_ = everywhere_ || !(p.allFinite() && p.z() > nearest);
      corners[i] = {camera.fx * p.x() / p.z() + camera.cx, camera.fy * p.y() / p.z() + camera.cy};
      rows_.include(corners[i].y());
    }
    // Each bit of a corner's number selects the lower or upper end of x, y or z.
    std::size_t edge = 0;
    for (int i = 0; i < 8; ++i) {
      for (const int bit : {1, 2, 4}) {
        if ((i & bit) == 0)
          edges_[edge++] = {corners[i], corners[i | bit]};
      }
    }
  }

  /// An interval that contains the columns that the solid covers in a row.
  Span columns(double row) const
  {
    Span columns;
    if (everywhere_)
      return {-kInfinity, kInfinity};
    if (row < rows_.low || row > rows_.high)
      return columns;
    for (const auto& [a, b] : edges_) {
      const double share = (row - a.y()) / (b.y() - a.y());
      if (share >= 0.0 && share <= 1.0)
        columns.include(a.x() + share * (b.x() - a.x()));
    }
    return columns;
  }

private:
  struct Edge
  {
    Eigen::Vector2d a, b;
  };

  bool everywhere_ = false;
  Span rows_;
  std::array<Edge, 12> edges_;
};

/// A part as the camera sees it.
struct Target
{
  const Primitive* shape;
  std::int32_t part;
  SurfaceImage* image;
  Outline outline;
  Eigen::Matrix3d R_shape_camera;
  Eigen::Vector3d camera_shape;  ///< the camera's origin in the shape's frame
};

}  // namespace

VisibleSurfaces findVisibleSurfaces(const Scene& scene, const Eigen::Isometry3d& T_scene_camera,
                                    const PinholeIntrinsics& camera, std::uint32_t width, std::uint32_t height)
{
  VisibleSurfaces visible;
  for (SurfaceImage* image : {&visible.opaque, &visible.transparent}) {
    image->depth.assign(std::size_t{width} * height, std::numeric_limits<float>::infinity());
    image->part.assign(std::size_t{width} * height, -1);
  }

  std::vector<Target> targets;
  for (const Part& part : scene.parts()) {
    const Eigen::Isometry3d T_shape_camera = part.T_scene_shape.inverse() * T_scene_camera;
    targets.push_back({&part.shape, static_cast<std::int32_t>(targets.size()),
                       part.surface == Surface::transparent ? &visible.transparent : &visible.opaque,
                       Outline(boundingBox(part.shape), T_shape_camera.inverse(), camera), T_shape_camera.linear(),
                       T_shape_camera.translation()});
  }

  forEachRow(height, [&](std::uint32_t row) {
    std::vector<double> t(width);
    for (const Target& target : targets) {
      const Span columns = target.outline.columns(row);
      const double first = std::max(0.0, std::ceil(columns.low));
      const double last = std::min(width - 1.0, std::floor(columns.high));
      if (!(first <= last))
        continue;

      // With a z of 1 in the camera's frame, t is the depth.
      const Eigen::Vector3d direction((first - camera.cx) / camera.fx, (row - camera.cy) / camera.fy, 1.0);
      const Eigen::Vector3d step(1.0 / camera.fx, 0.0, 0.0);
      const auto count = static_cast<std::size_t>(last - first) + 1;
      intersect(*target.shape, target.camera_shape, target.R_shape_camera * direction, target.R_shape_camera * step,
                count, t.data());

      const std::size_t pixel = std::size_t{row} * width + static_cast<std::size_t>(first);
      float* depth = target.image->depth.data() + pixel;
      std::int32_t* part = target.image->part.data() + pixel;
      for (std::size_t i = 0; i < count; ++i) {
        if (t[i] < depth[i]) {
          depth[i] = static_cast<float>(t[i]);
          part[i] = target.part;
        }
      }
    }
  });
  return visible;
}

}  // namespace grasp_affordances
