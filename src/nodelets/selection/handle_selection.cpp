#include "nodelets/selection/handle_selection.h"

#include "nodelets/messages/conversions.h"

#include <ros/console.h>
#include <visualization_msgs/InteractiveMarkerUpdate.h>
#include <boost/function.hpp>

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace grasp_affordances
{
namespace
{

constexpr char kInteractive[] = "handles_interactive";
constexpr char kLazy[] = "a lazy node waits until somebody listens to an output";

}  // namespace

void HandleSelection::advertise(ros::NodeHandle& private_node_handle, const std::string& name, double max_age,
                                const std::function<void()>& listeners_changed)
{
  name_ = name;
  max_age_ = max_age;
  const auto changed = [listeners_changed](const ros::SingleSubscriberPublisher&) { listeners_changed(); };
  const auto advertise_latched = [&](const std::string& topic, auto message) {
    return private_node_handle.advertise<decltype(message)>(topic, 1, changed, changed, ros::VoidConstPtr(), true);
  };
  selected_publisher_ = advertise_latched("selected", Handle());
  selected_pose_publisher_ = advertise_latched("selected_pose", geometry_msgs::PoseStamped());

  const std::string topic = private_node_handle.resolveName(kInteractive);
  interactive_update_ = private_node_handle.advertise<visualization_msgs::InteractiveMarkerUpdate>(
      topic + "/update", 100, changed, changed);
  if (!interactive_update_) {  // the server of interactive_markers would assert that it can advertise
    throw std::runtime_error("ROS is shutting down");
  }
  display_ = std::make_unique<HandleDisplay>(
      topic, [this](std::uint32_t id, std::optional<HandleMenu> entry) { act(id, entry); });

  ros::NodeHandle services(thread_.nodeHandle(private_node_handle));
  select_service_ = services.advertiseService(
      "select", boost::function<bool(SelectHandle::Request&, SelectHandle::Response&)>(
                    gate_.guarded([this](auto& request, auto& response) { return answerSelect(request, response); })));
  best_service_ = services.advertiseService(
      "best", boost::function<bool(BestHandle::Request&, BestHandle::Response&)>(
                  gate_.guarded([this](auto& request, auto& response) { return answerBest(request, response); })));
  thread_.start();
}

bool HandleSelection::anybodyListens() const
{
  return selected_publisher_.getNumSubscribers() > 0 || selected_pose_publisher_.getNumSubscribers() > 0 ||
         interactive_update_.getNumSubscribers() > 0;
}

void HandleSelection::close()
{
  gate_.close();
  thread_.stop();
  thread_.end(select_service_);
  thread_.end(best_service_);
  if (display_) {
    display_->close();
  }
}

void HandleSelection::update(const std::vector<GraspHandle>& handles, const Config& config,
                             const std_msgs::Header& header, const Moment& arrival)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (header.frame_id != header_.frame_id) {
    choice_.reset();  // its directions are those of another frame
  }
  arrival_ = arrival;
  header_ = header;
  handles_ = handles;
  geometry_ = config.hand;
  T_hand_tool_ = toolInHand(config.hand_poses);
  if (selected_ != 0) {
    if (const GraspHandle* handle = find(selected_)) {
      chooseHandPose(choice_.follow(*handle, T_hand_tool_), *handle);
      publish(*handle);
    } else {
      ROS_INFO_STREAM_NAMED(name_, "handle " << selected_ << " is lost, and none is selected any more");
      deselect();
    }
  }
  showSelection();
}

void HandleSelection::act(std::uint32_t id, std::optional<HandleMenu> entry)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const GraspHandle* handle = find(id);
  if (handle == nullptr) {
    return;  // it was clicked at when it had just been lost
  }
  const bool selected = id == selected_;
  if (selected && (!entry || *entry == HandleMenu::deselect)) {
    ROS_INFO_STREAM_NAMED(name_, "handle " << id << " is deselected");
    deselect();
  } else if (!selected && (!entry || *entry == HandleMenu::select)) {
    select(*handle);
  } else if (selected && (*entry == HandleMenu::next_hand_pose || *entry == HandleMenu::previous_hand_pose)) {
    chooseHandPose(choice_.step(*handle, T_hand_tool_, *entry == HandleMenu::previous_hand_pose), *handle);
    publish(*handle);
  } else {
    return;
  }
  showSelection();
}

bool HandleSelection::answerSelect(SelectHandle::Request& request, SelectHandle::Response& response)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const GraspHandle* handle = find(request.id);
  response.message = request.id == 0 ? "" : whyTooOld();
  if (!response.message.empty()) {
    return true;
  }
  if (request.id != 0 && handle == nullptr) {
    response.message = "no handle " + std::to_string(request.id) + " is known; " + knownIds();
    return true;
  }
  response.success = true;
  if (handle != nullptr) {
    select(*handle);
    response.handle = handleMessage(*handle, header_);
  } else if (selected_ != 0) {
    deselect();
  }
  showSelection();
  return true;
}

bool HandleSelection::answerBest(BestHandle::Request& request, BestHandle::Response& response)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  response.age = age();
  response.message = whyTooOld();
  if (!response.message.empty()) {
    return true;
  }
  const GraspHandle* handle = best();
  if (handle == nullptr) {
    response.message = handles_.empty() ? knownIds() : "none of the handles can be approached; " + knownIds();
    return true;
  }
  response.success = true;
  response.handle = handleMessage(*handle, header_);
  response.hand_pose = handPose(*handle, 0);
  if (request.select) {
    choice_.reset();  // a pose that was chosen before gives way to the best
    select(*handle);
    showSelection();
  }
  return true;
}

const GraspHandle* HandleSelection::find(std::uint32_t id) const
{
  const auto found =
      std::find_if(handles_.begin(), handles_.end(), [&](const GraspHandle& handle) { return handle.id == id; });
  return found == handles_.end() ? nullptr : &*found;
}

const GraspHandle* HandleSelection::best() const
{
  const GraspHandle* best = nullptr;
  for (const GraspHandle& handle : handles_) {
    if (!handle.hand_poses.empty() && (best == nullptr || handle.score > best->score)) {
      best = &handle;
    }
  }
  return best;
}

double HandleSelection::age() const
{
  return arrival_ ? secondsBetween(*arrival_, Moment::now()) : std::numeric_limits<double>::quiet_NaN();
}

/// Empty where the handles still count.
std::string HandleSelection::whyTooOld() const
{
  const double seconds = age();
  std::ostringstream text;
  if (max_age_ > 0.0 && seconds > max_age_) {
    text << "the last cloud that was localized in came " << std::fixed << std::setprecision(1) << seconds
         << " s ago, and handles older than " << std::defaultfloat << std::setprecision(6) << max_age_
         << " s do not count (max_age; " << kLazy << ")";
  }
  return text.str();
}

std::string HandleSelection::knownIds() const
{
  if (!arrival_) {
    return std::string("nothing has been localized yet (") + kLazy + ")";
  }
  if (handles_.empty()) {
    return "no handle is known";
  }
  std::string ids;
  for (const GraspHandle& handle : handles_) {
    ids += (ids.empty() ? "known are " : ", ") + std::to_string(handle.id);
  }
  return ids;
}

void HandleSelection::select(const GraspHandle& handle)
{
  if (handle.id != selected_) {
    ROS_INFO_STREAM_NAMED(name_, "handle " << handle.id << " is selected");
    selected_ = handle.id;
    choice_.reset();
    complained_ = false;
  }
  chooseHandPose(choice_.follow(handle, T_hand_tool_), handle);
  publish(handle);
}

/// The latched pose remains: a PoseStamped cannot say that there is none.
void HandleSelection::deselect()
{
  selected_ = 0;
  choice_.reset();
  hand_pose_.reset();
  complained_ = false;
  Handle none;
  none.header = header_;
  none.pose.orientation.w = 1.0;
  selected_publisher_.publish(none);
}

void HandleSelection::chooseHandPose(std::optional<std::size_t> index, const GraspHandle& handle)
{
  hand_pose_ = index;
  if (!index && !complained_) {
    ROS_WARN_STREAM_NAMED(name_, "handle " << handle.id << " has no hand poses: no approach to it is seen to be free, "
                                           << "and selected_pose is not published");
  }
  complained_ = !index;
}

void HandleSelection::publish(const GraspHandle& handle)
{
  selected_publisher_.publish(handleMessage(handle, header_));
  if (hand_pose_) {
    selected_pose_publisher_.publish(handPose(handle, *hand_pose_));
  }
}

geometry_msgs::PoseStamped HandleSelection::handPose(const GraspHandle& handle, std::size_t index) const
{
  geometry_msgs::PoseStamped message;
  message.header = header_;
  message.pose = poseMessage(handle.hand_poses[index].pose);
  return message;
}

void HandleSelection::showSelection()
{
  HandleDisplay::Scene scene;
  scene.header = header_;
  scene.handles = handles_;
  scene.selected = selected_;
  scene.geometry = geometry_;
  if (hand_pose_) {
    scene.hand = find(selected_)->hand_poses[*hand_pose_];
    scene.hand->pose = scene.hand->pose * T_hand_tool_.inverse();
  }
  display_->show(std::move(scene));
}

}  // namespace grasp_affordances
