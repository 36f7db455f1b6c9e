#include "evaluation/close_up.h"

#include "core/cloud/usable_cloud.h"
#include "core/result/axis_frame.h"
#include "simulation/ground_truth.h"

#include <Eigen/Geometry>

#include <cmath>
#include <optional>

namespace grasp_affordances
{
namespace
{

constexpr Color kGraspable{0.1F, 0.95F, 0.2F};
constexpr Color kDoubtfulColor{1.0F, 0.9F, 0.1F};
constexpr Color kGrey{0.75F, 0.75F, 0.75F};
constexpr Color kMarked{1.0F, 0.1F, 0.9F};

struct ColoredPoint
{
  Eigen::Vector3f position;
  Color color;
};

ColoredCloud unorganizedCloud(const std::vector<ColoredPoint>& points)
{
  ColoredCloud result;
  result.cloud.reset(static_cast<std::uint32_t>(points.size()), 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f& p = points[i].position;
    result.cloud.set(i, p.x(), p.y(), p.z());
    result.colors.push_back(points[i].color);
  }
  return result;
}

}  // namespace

std::vector<Color> labelColors(const std::vector<std::uint32_t>& labels, std::uint32_t marked)
{
  std::vector<Color> colors;
  colors.reserve(labels.size());
  for (const std::uint32_t label : labels) {
    colors.push_back(label == kNotGraspable ? kGrey
                     : label == kDoubtful   ? kDoubtfulColor
                     : label == marked      ? kMarked
                                            : kGraspable);
  }
  return colors;
}

ColoredCloud closeUp(const Cloud& cloud, const std::vector<Color>& colors, const Eigen::Vector3d& center, double radius)
{
  UsableCloud usable;
  usable.update(cloud);
  const std::optional<RangeImage>& image = usable.image();
  if (!image) {
    std::vector<ColoredPoint> points;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if ((cloud.point(i).cast<double>() - center).norm() <= radius) {  // false for NaN
        points.push_back({cloud.point(i), colors[i]});
      }
    }
    ColoredCloud result = unorganizedCloud(points);
    result.cloud.sensor_origin = cloud.sensor_origin;
    return result;
  }
  const PixelWindow window = image->window(center, radius);
  ColoredCloud result;
  result.cloud.reset(static_cast<std::uint32_t>(window.u_end - window.u_begin),
                     static_cast<std::uint32_t>(window.v_end - window.v_begin));
  std::size_t pixel = 0;
  for (int v = window.v_begin; v < window.v_end; ++v) {
    for (int u = window.u_begin; u < window.u_end; ++u, ++pixel) {
      const std::size_t i = static_cast<std::size_t>(v) * cloud.width + static_cast<std::size_t>(u);
      result.cloud.set(pixel, cloud.x[i], cloud.y[i], cloud.z[i]);
      result.colors.push_back(colors[i]);
    }
  }
  PinholeIntrinsics intrinsics = image->intrinsics();
  intrinsics.cx -= window.u_begin;
  intrinsics.cy -= window.v_begin;
  result.cloud.intrinsics = intrinsics;
  return result;
}

ColoredCloud crossSection(const Cloud& cloud, const std::vector<Color>& colors, Shell& shell)
{
  const double radius = 2.5 * (shell.inner_radius + shell.thickness);
  Eigen::Matrix3d rotation;  // rows: the camera's x, y and z
  const Eigen::Vector3d normal = normalOrAny(shell.axis, shell.normal);
  rotation << shell.axis.cross(normal).transpose(), -normal.transpose(), shell.axis.transpose();
  const Eigen::Vector3d place(0.0, 0.0, 2.0);
  std::vector<ColoredPoint> points;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = rotation * (cloud.point(i).cast<double>() - shell.centroid);
    if (std::abs(p.z()) <= shell.length / 2 && p.head<2>().norm() <= radius) {  // false for NaN
      points.push_back({(place + p).cast<float>(), colors[i]});
    }
  }
  shell.centroid = place;
  shell.axis = Eigen::Vector3d::UnitZ();
  shell.normal = -Eigen::Vector3d::UnitY();
  return unorganizedCloud(points);
}

}  // namespace grasp_affordances
