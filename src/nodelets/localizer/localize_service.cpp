#include "nodelets/localizer/localize_service.h"

#include "grasp_affordances/point_cloud2.h"
#include "nodelets/messages/conversions.h"
#include "nodelets/messages/region_of_interest.h"

#include <sensor_msgs/CameraInfo.h>
#include <std_msgs/Header.h>

#include <chrono>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace grasp_affordances
{
namespace
{

/// The projection of the cloud that a call brings; nothing where it brings none.
/// @throw std::invalid_argument for one that does not fit
std::optional<PinholeIntrinsics> intrinsicsOfCall(const sensor_msgs::CameraInfo& camera, const Cloud& cloud)
{
  if (!cloud.organized() || (camera.width == 0 && camera.height == 0)) {
    return std::nullopt;
  }
  try {
    return intrinsicsFromCameraInfo(camera, cloud.width, cloud.height);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string("the camera_info does not fit: ") + error.what());
  }
}

}  // namespace

void LocalizeService::advertise(const ros::NodeHandle& private_node_handle, const Reconfiguration& reconfiguration,
                                MakeLocalizer make_localizer)
{
  reconfiguration_ = &reconfiguration;
  make_localizer_ = std::move(make_localizer);
  server_ = thread_.nodeHandle(private_node_handle).advertiseService("localize", &LocalizeService::call, this);
  thread_.start();
}

void LocalizeService::close()
{
  thread_.stop();
  thread_.end(server_);
}

bool LocalizeService::call(Localize::Request& request, Localize::Response& response)
{
  try {
    answer(request, response);
    response.success = true;
    response.message = response.statistics.explanation;
  } catch (const std::exception& error) {  // also no memory for what a cloud asks for
    response = Localize::Response();
    response.success = false;
    response.message = error.what();
  }
  return true;
}

void LocalizeService::answer(const Localize::Request& request, Localize::Response& response)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const Config config = withRegion(reconfiguration_->config(), request.region);
  if (!localizer_) {
    localizer_ = make_localizer_(config);
  }
  cloudFromPointCloud2(request.cloud, cloud_);
  cloud_.intrinsics = intrinsicsOfCall(request.camera_info, cloud_);
  const std_msgs::Header& common = request.cloud.header;
  const FramedLocalizer::Frames frames = localizer_->lookUp(common, {common}, request.region, request.sensor);
  const std_msgs::Header header = localizer_->localize({&cloud_}, common, frames, config);
  const Localization& localization = localizer_->localization();
  response.shells = shellsMessage(localization, header).shells;
  response.handles = handlesMessage(localization.handles, header).handles;
  response.statistics = statisticsMessage(localization, config, header);
  response.statistics.milliseconds_latency = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace grasp_affordances
