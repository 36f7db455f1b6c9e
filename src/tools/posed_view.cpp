#include "tools/posed_view.h"

#include "grasp_affordances/point_cloud2.h"
#include "io/pcd.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace grasp_affordances
{

std::size_t PosedView::measuredPoints() const
{
  return static_cast<std::size_t>(
      std::count_if(cloud.x.begin(), cloud.x.end(), [](float x) { return !std::isnan(x); }));
}

PosedView readPosedView(const std::string& file, const std::optional<Eigen::Isometry3d>& T_common_cloud)
{
  SensorPose viewpoint;
  const pcl::PCLPointCloud2 points = readPcd(file, &viewpoint);
  const auto pose = T_common_cloud ? T_common_cloud : viewpoint.transform();
  if (!pose) {
    throw CloudError("the quaternion of VIEWPOINT is not of unit length");
  }
  PosedView view{Cloud(), {}, *pose};
  if (!T_common_cloud && viewpoint.sensorOrigin()) {
    view.cloud.sensor_origin = Eigen::Vector3f::Zero();
  }
  cloudFromPointCloud2(points, view.cloud);
  view.colors = pointColors(points);
  return view;
}

Cloud cloudInCommonFrame(const std::vector<PosedView>& views, std::vector<Color>& colors)
{
  constexpr Color kGrey{0.78F, 0.78F, 0.78F};
  std::size_t points = 0;
  bool colored = false;
  for (const PosedView& view : views) {
    points += view.cloud.size();
    colored = colored || !view.colors.empty();
  }
  Cloud all;
  all.reset(static_cast<std::uint32_t>(points), 1);
  colors.clear();
  std::size_t index = 0;
  for (const PosedView& view : views) {
    for (std::size_t i = 0; i < view.cloud.size(); ++i, ++index) {
      const Eigen::Vector3f point = (view.T_common_cloud * view.cloud.point(i).cast<double>()).cast<float>();
      all.set(index, point.x(), point.y(), point.z());
      if (colored) {
        colors.push_back(view.colors.empty() ? kGrey : view.colors[i]);
      }
    }
  }
  return all;
}

}  // namespace grasp_affordances
