#include "nodelets/localizer/framed_localizer.h"

#include "nodelets/messages/region_of_interest.h"
#include "nodelets/roscpp/frame_name.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace grasp_affordances
{
namespace
{

// s at least that a call waits for the transforms of its region or sensor, as it may be the first one to need any.
constexpr double kCallTimeout = 1.0;

Eigen::Vector3d placeOf(const geometry_msgs::PointStamped& sensor)
{
  const Eigen::Vector3d place(sensor.point.x, sensor.point.y, sensor.point.z);
  if (!place.allFinite()) {
    throw std::invalid_argument("the sensor's place is not finite");
  }
  if (sensor.header.frame_id.empty() && !place.isZero(0.0)) {
    throw std::invalid_argument("the sensor's place has no frame (sensor.header.frame_id)");
  }
  return place;
}

}  // namespace

FramedLocalizer::FramedLocalizer(const NodeParameters& parameters, const Config& config, Transforms& transforms,
                                 std::function<bool()> cancelled)
    : parameters_(parameters), transforms_(transforms), localizer_(config)
{
  localizer_.cancelWhen(std::move(cancelled));
}

FramedLocalizer::Frames FramedLocalizer::lookUp(const std_msgs::Header& common,
                                                const std::vector<std_msgs::Header>& clouds,
                                                const RegionOfInterest& region,
                                                const geometry_msgs::PointStamped& sensor)
{
  const Eigen::Vector3d sensor_place = placeOf(sensor);
  const bool calls_for_frames = hasRegion(region) || !sensor.header.frame_id.empty();
  const double timeout =
      calls_for_frames ? std::max(parameters_.transform_timeout, kCallTimeout) : parameters_.transform_timeout;
  const Transforms::Deadline deadline = Transforms::after(timeout);
  const auto transform = [&](const std::string& target, const std_msgs::Header& source) {
    return target.empty() ? Eigen::Isometry3d(Eigen::Isometry3d::Identity())
                          : transforms_.lookup(target, source.frame_id, source.stamp, deadline);
  };
  const std::string& sensor_frame = sensor.header.frame_id.empty() ? parameters_.sensor_frame : sensor.header.frame_id;
  Frames result;
  for (const std_msgs::Header& cloud : clouds) {
    result.T_common_cloud.push_back(transform(common.frame_id, cloud));
    std::optional<Eigen::Vector3f>& origin = result.sensor_origin.emplace_back();
    if (!sensor_frame.empty()) {
      origin = (transform(sensor_frame, cloud).inverse() * sensor_place).cast<float>();
    }
  }
  const std::string workspace_frame = regionFrame(region, parameters_.workspace_frame);
  result.workspace_frame = frameName(workspace_frame.empty() ? common.frame_id : workspace_frame);
  result.T_workspace_common = transform(workspace_frame, common);
  result.T_output_common = transform(parameters_.target_frame, common);
  result.T_approach_common = transform(parameters_.approach_frame, common);
  std_msgs::Header output = common;
  if (!parameters_.target_frame.empty()) {
    output.frame_id = parameters_.target_frame;
  }
  result.fixed = {parameters_.fixed_frame, transform(parameters_.fixed_frame, output)};
  return result;
}

std_msgs::Header FramedLocalizer::localize(const std::vector<Cloud*>& clouds, const std_msgs::Header& common,
                                           const Frames& frames, const Config& config)
{
  posed_clouds_.resize(clouds.size());
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    clouds[i]->sensor_origin = frames.sensor_origin[i];
    posed_clouds_[i] = {clouds[i], frames.T_common_cloud[i]};
  }
  localizer_.configure(config);
  localizer_.localize(posed_clouds_, localization_, frames.T_workspace_common, frames.T_approach_common);
  std_msgs::Header output = common;
  output.frame_id = frameName(common.frame_id);
  if (!parameters_.target_frame.empty() && parameters_.target_frame != output.frame_id) {
    output.frame_id = parameters_.target_frame;
    for (Shell& shell : localization_.shells) {
      shell = transformed(shell, frames.T_output_common);
    }
    for (GraspHandle& handle : localization_.handles) {
      handle = transformed(std::move(handle), frames.T_output_common);
    }
  }
  return output;
}

}  // namespace grasp_affordances
