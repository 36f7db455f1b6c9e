#include "nodelets/localizer/localizing_loop.h"

#include "grasp_affordances/localizer.h"
#include "nodelets/messages/region_of_interest.h"
#include "nodelets/roscpp/frame_name.h"
#include "nodelets/roscpp/ros_time.h"

#include <ros/console.h>
#include <ros/init.h>
#include <tf2/exceptions.h>

#include <exception>

namespace grasp_affordances
{
namespace
{

bool namesAFrame(const NodeParameters& parameters)
{
  return !parameters.workspace_frame.empty() || !parameters.target_frame.empty() || !parameters.fixed_frame.empty() ||
         !parameters.approach_frame.empty() || !parameters.sensor_frame.empty();
}

std::string joined(const std::vector<std::string>& lines)
{
  std::string text;
  for (const std::string& line : lines) {
    text += (text.empty() ? "" : "; ") + line;
  }
  return text;
}

}  // namespace

LocalizingLoop::~LocalizingLoop()
{
  // In this order: no more clouds come in, and nobody waits; services end; then the last cloud is given up while its
  // publishers still exist.
  ending_ = true;
  publishers_.close();
  demand_.close();
  if (setup_.input) {  // it started
    setup_.input->close();
  }
  if (transforms_) {
    transforms_->close();
  }
  trigger_.close();
  localize_service_.close();
  reconfiguration_.close();
  worker_.reset();
}

void LocalizingLoop::start(ros::NodeHandle& node_handle, const ros::NodeHandle& private_node_handle,
                           const std::string& name, const std::function<Setup()>& set_up)
{
  name_ = name;
  transforms_ = std::make_unique<Transforms>(node_handle);
  try {
    name_claim_.claim(name);
    setup_ = set_up();
    localizer_ = makeLocalizer(setup_.parameters.config);
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM_NAMED(name, name << " does not start: " << error.what());  // the loader drops what it catches
    throw;
  }
  const NodeParameters& parameters = setup_.parameters;
  clock_complaint_ = complainWithoutClock(node_handle, name);
  if (setup_.always_listens_to_tf || parameters.on_demand || namesAFrame(parameters)) {
    transforms_->listen();
  }
  rate_limiter_.emplace(parameters.max_rate);
  reconfiguration_.advertise(private_node_handle, name, parameters.config);
  worker_ = std::make_unique<NewestOnlyWorker<Arrival>>([this](const Arrival& arrival) { process(arrival); });
  publishers_.advertise(private_node_handle, name, longestAge(parameters), [this] { demand_.update(); });
  trigger_.advertise(private_node_handle, setup_.input->awaited(),
                     [this](bool needed) { return demand_.demand(needed); });
  if (setup_.offers_localize) {
    localize_service_.advertise(private_node_handle, reconfiguration_,
                                [this](const Config& config) { return makeLocalizer(config); });
  }
  const CloudInput::Receiver receiver{[this](const CloudInput::Clouds& clouds) { receive(clouds); },
                                      [this](const ros::Time& stamp) { startAgain(stamp); }};
  // Last, shortly before onInit() returns: nodelet 1.10 drops what arrives until then.
  demand_.open(name,
               {parameters.lazy, parameters.on_demand, [this] { return publishers_.anybodyListens(); },
                [this, receiver] { setup_.input->subscribe(receiver); }, [this] { setup_.input->unsubscribe(); }});
}

/// ROS tells nobody who waits for a service that the node ends. So the work is given up then.
std::unique_ptr<FramedLocalizer> LocalizingLoop::makeLocalizer(const Config& config)
{
  return std::make_unique<FramedLocalizer>(setup_.parameters, config, *transforms_,
                                           [this] { return ending_ || ros::isShuttingDown(); });
}

void LocalizingLoop::receive(const CloudInput::Clouds& clouds)
{
  const Moment now = Moment::now();
  const bool asked = trigger_.arrives(now.steady);
  if (!asked && (setup_.parameters.on_demand ||
                 !rate_limiter_->passes(std::chrono::nanoseconds(now.steady.time_since_epoch()).count()))) {
    counters_.leaveOut();
    return;
  }
  counters_.receive([&] { return worker_->put({clouds, now}); });
}

void LocalizingLoop::startAgain(const ros::Time& stamp)
{
  if (reported_jumps_.due()) {
    ROS_INFO_STREAM_NAMED(name_, "time goes back to " << stamp);
  }
  transforms_->restart();
}

void LocalizingLoop::process(const Arrival& arrival)
{
  const std::optional<RegionOfInterest> call = trigger_.take(arrival.time.steady);
  try {
    localize(arrival, call);
  } catch (const tf2::TransformException& error) {
    counters_.leaveUntransformed();
    if (missing_transforms_.due()) {
      ROS_WARN_STREAM_NAMED(name_, "cloud dropped for want of a transform: " << error.what());
    }
    trigger_.fail(error.what());
  } catch (const Cancelled& error) {
    trigger_.fail(error.what());
  } catch (const std::exception& error) {  // CloudError, or no memory for what a cloud asks for
    counters_.reject();
    if (rejections_.due()) {
      ROS_ERROR_STREAM_NAMED(name_, "cloud rejected: " << error.what());
    }
    trigger_.fail(error.what());
  }
}

/// The way of a cloud, stage by stage.
void LocalizingLoop::localize(const Arrival& arrival, const std::optional<RegionOfInterest>& call)
{
  const RegionOfInterest region = call.value_or(RegionOfInterest());
  Config config = withRegion(reconfiguration_.config(), region);
  if (call) {
    config.tracking.min_hits = 1;  // who asks once is answered at once
  }
  const CloudInput::Gathered gathered = setup_.input->gather(arrival.clouds);
  std::vector<std_msgs::Header> headers;
  for (const sensor_msgs::PointCloud2ConstPtr& cloud : arrival.clouds) {
    headers.push_back(cloud->header);
  }
  warnOfSlashes(headers);
  const FramedLocalizer::Frames frames = localizer_->lookUp(gathered.header, headers, region);
  const std_msgs::Header header = localizer_->localize(gathered.clouds, gathered.header, frames, config);
  const Localization& localization = localizer_->localization();
  counters_.process();
  if (!localization.warnings.empty() && warnings_.due()) {
    ROS_WARN_STREAM_NAMED(name_, joined(localization.warnings));
  }
  const std::vector<GraspHandle>& known =
      handle_tracking_.update(localization.handles, config.tracking, header, arrival.time.steady, frames.fixed);
  warnOfFrames(header);
  trigger_.answer(
      publishers_.publish({localization, known, config, header, frames.workspace_frame, arrival.time}, counters_));
}

void LocalizingLoop::warnOfSlashes(const std::vector<std_msgs::Header>& clouds)
{
  for (const std_msgs::Header& cloud : clouds) {
    const std::string frame = frameName(cloud.frame_id);
    if (!warned_of_slashes_ && frame != cloud.frame_id) {
      ROS_WARN_STREAM_NAMED(name_, "clouds come in the frame '" << cloud.frame_id << "', which is taken for '" << frame
                                                                << "': tf2 knows no leading slash");
      warned_of_slashes_ = true;
    }
  }
}

void LocalizingLoop::warnOfFrames(const std_msgs::Header& output)
{
  const std::string& before = handle_tracking_.frameBefore();
  if (!warned_of_frames_ && !before.empty()) {
    ROS_WARN_STREAM_NAMED(name_, "handles get new ids whenever clouds come in another frame, as now in '"
                                     << output.frame_id << "' after '" << before
                                     << "': fixed_frame can name one in which they are tracked all the same");
    warned_of_frames_ = true;
  }
}

}  // namespace grasp_affordances
