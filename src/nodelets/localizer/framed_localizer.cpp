#include "nodelets/localizer/framed_localizer.h"

#include "nodelets/messages/region_of_interest.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace grasp_affordances
{
namespace
{

// s at least that a call waits for the transforms of its region, as it may be the first one to need any.
constexpr double kRegionTimeout = 1.0;

}  // namespace

FramedLocalizer::FramedLocalizer(const NodeParameters& parameters, const Config& config, Transforms& transforms,
                                 std::function<bool()> cancelled)
    : parameters_(parameters), transforms_(transforms), localizer_(config)
{
  localizer_.cancelWhen(std::move(cancelled));
}

FramedLocalizer::Frames FramedLocalizer::lookUp(const std_msgs::Header& common,
                                                const std::vector<std_msgs::Header>& clouds,
                                                const RegionOfInterest& region)
{
  const double timeout =
      hasRegion(region) ? std::max(parameters_.transform_timeout, kRegionTimeout) : parameters_.transform_timeout;
  const Transforms::Deadline deadline = Transforms::after(timeout);
  const auto transform = [&](const std::string& target, const std_msgs::Header& source) {
    return target.empty() ? Eigen::Isometry3d(Eigen::Isometry3d::Identity())
                          : transforms_.lookup(target, source.frame_id, source.stamp, deadline);
  };
  Frames result;
  for (const std_msgs::Header& cloud : clouds) {
    result.T_common_cloud.push_back(transform(common.frame_id, cloud));
  }
  const std::string workspace_frame = regionFrame(region, parameters_.workspace_frame);
  result.workspace_frame = workspace_frame.empty() ? common.frame_id : workspace_frame;
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

std_msgs::Header FramedLocalizer::localize(const std::vector<const Cloud*>& clouds, const std_msgs::Header& common,
                                           const Frames& frames, const Config& config)
{
  posed_clouds_.resize(clouds.size());
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    posed_clouds_[i] = {clouds[i], frames.T_common_cloud[i]};
  }
  localizer_.configure(config);
  localizer_.localize(posed_clouds_, localization_, frames.T_workspace_common, frames.T_approach_common);
  std_msgs::Header output = common;
  if (!parameters_.target_frame.empty() && parameters_.target_frame != common.frame_id) {
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
