#include "nodelets/roscpp/transforms.h"

#include "nodelets/roscpp/frame_name.h"
#include "nodelets/roscpp/subscribing.h"

#include <ros/console.h>
#include <ros/duration.h>
#include <ros/init.h>
#include <ros/wall_timer_options.h>
#include <tf2/exceptions.h>
#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <cstdint>
#include <exception>

namespace grasp_affordances
{
namespace
{

constexpr std::uint32_t kSubscriberQueue = 100;
constexpr std::uint32_t kThreads = 1;
constexpr std::chrono::milliseconds kShutdownPoll{50};  // nothing tells of the end of the node
constexpr double kClockPoll = 0.5;                      // s, of wall-clock time; nothing tells of a clock set back

/// tf2 also takes quaternions of which few digits were given, and does not normalize them.
Eigen::Isometry3d isometry(geometry_msgs::TransformStamped transform)
{
  Eigen::Quaterniond rotation;
  tf2::fromMsg(transform.transform.rotation, rotation);
  transform.transform.rotation = tf2::toMsg(rotation.normalized());
  return tf2::transformToEigen(transform);
}

}  // namespace

Transforms::Transforms(const ros::NodeHandle& node_handle) : node_handle_(node_handle), spinner_(kThreads, &queue_) {}

Transforms::~Transforms()
{
  spinner_.stop();
  const std::lock_guard<std::mutex> alone(subscribing());
  clock_watch_.stop();
  moving_.shutdown();
  fixed_.shutdown();
}

void Transforms::listen()
{
  const std::lock_guard<std::mutex> lock(listening_mutex_);
  if (moving_) {
    return;
  }
  using Event = ros::MessageEvent<const tf2_msgs::TFMessage>;
  const auto subscribe = [&](const std::string& topic, bool fixed) {
    ros::SubscribeOptions options;
    options.initByFullCallbackType<const Event&>(topic, kSubscriberQueue,
                                                 [this, fixed](const Event& event) { receive(event, fixed); });
    options.callback_queue = &queue_;
    return node_handle_.subscribe(options);
  };
  const std::lock_guard<std::mutex> alone(subscribing());
  moving_ = subscribe("/tf", false);
  fixed_ = subscribe("/tf_static", true);
  if (ros::Time::isSimTime()) {  // transforms may pause until the clock is again where it was
    ros::WallTimerOptions options;
    options.period = ros::WallDuration(kClockPoll);
    options.callback = [this](const ros::WallTimerEvent&) {
      const std::lock_guard<std::mutex> lock(mutex_);
      lookAtClock();
    };
    options.callback_queue = &queue_;
    clock_watch_ = node_handle_.createWallTimer(options);
  }
  spinner_.start();
}

Eigen::Isometry3d Transforms::lookup(const std::string& target_frame, const std::string& source_frame,
                                     const ros::Time& stamp, Deadline deadline)
{
  const std::string target = frameName(target_frame);
  const std::string source = frameName(source_frame);
  if (target == source) {
    return Eigen::Isometry3d::Identity();
  }
  listen();
  std::unique_lock<std::mutex> lock(mutex_);
  lookAtClock();
  remember(target, source, ros::Time());
  while (!source.empty() && !buffer_.canTransform(target, source, stamp)) {  // for no source nobody needs to wait
    const auto now = std::chrono::steady_clock::now();
    if (closed_ || ros::isShuttingDown() || now >= deadline) {
      break;
    }
    changed_.wait_until(lock, std::min<Deadline>(deadline, now + kShutdownPoll));
  }
  try {
    const geometry_msgs::TransformStamped transform = buffer_.lookupTransform(target, source, stamp);
    remember(target, source, stamp);
    if (!stamp.isZero() && stamp <= newest_) {  // also what is asked for is of this run
      restarted_ = false;
    }
    return isometry(transform);
  } catch (const tf2::TransformException&) {
    throw;
  } catch (const std::exception& error) {  // roscpp's: from the known stamps it is farther than a Duration can be
    throw tf2::ExtrapolationException(error.what());
  }
}

void Transforms::restart()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!restarted_) {
    forget();
  }
  restarted_ = false;
}

void Transforms::close()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

void Transforms::receive(const ros::MessageEvent<const tf2_msgs::TFMessage>& event, bool fixed)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  lookAtClock();
  for (const geometry_msgs::TransformStamped& transform : event.getMessage()->transforms) {
    if (!leavesRoom(transform.header.stamp)) {  // tf2 adds the length of its memory
      if (refusals_.due()) {
        ROS_WARN_STREAM("a transform was ignored: its stamp, " << transform.header.stamp.sec
                                                               << " s, is too large to compute with");
      }
      continue;
    }
    if (!fixed && wentBack(transform)) {
      const std::string frame = frameName(transform.child_frame_id);
      if (asked_.count(frame) > 0) {
        startAgain(frame, transform.header.stamp);
        wentBack(transform);  // the first of the new run
      } else {
        returned_[frame] = transform.header.stamp;
      }
    }
    if (!fixed) {
      newest_ = std::max(newest_, transform.header.stamp);
    }
    buffer_.setTransform(transform, event.getPublisherName(), fixed);
  }
  changed_.notify_all();
}

bool Transforms::wentBack(const geometry_msgs::TransformStamped& transform)
{
  const auto stream = streams_.try_emplace(transform.child_frame_id, ros::Duration(kDisorder)).first;
  return stream->second.wentBack(transform.header.stamp);
}

/// Where the ROS clock went back, transforms of later times are of another run. The first ones of the new run may have
/// come before, and the others been forgotten on their account.
void Transforms::lookAtClock()
{
  if (!ros::Time::isSimTime()) {
    return;
  }
  const ros::Time now = ros::Time::now();
  const bool back = isEarlier(now, clock_, ros::Duration(kDisorder));
  clock_ = now;
  if (!back) {
    return;
  }
  if (isEarlier(now, newest_, ros::Duration(kDisorder))) {
    if (restarts_.due()) {
      ROS_INFO_STREAM("transforms begin anew: /clock goes back to " << now);
    }
    forget();
  }
  restarted_ = true;
}

/// Keeps the names of the frames on the way between two that are related at this time (zero: the latest).
void Transforms::remember(const std::string& target, const std::string& source, const ros::Time& stamp)
{
  constexpr int kDeepest = 1000;  // as in tf2; frames above those that are related may form a loop
  for (std::string frame : {target, source}) {
    std::string parent;
    for (int depth = 0; depth < kDeepest && buffer_._getParent(frame, stamp, parent); ++depth) {
      asked_.insert(frame);
      if (const auto returned = returned_.find(frame); returned != returned_.end()) {
        startAgain(frame, returned->second);
        return;
      }
      frame = parent;
    }
  }
}

/// The stamps of a frame that was asked for went back.
void Transforms::startAgain(const std::string& frame, const ros::Time& stamp)
{
  if (restarts_.due()) {
    ROS_INFO_STREAM("transforms begin anew: those of " << frame << " go back to " << stamp);
  }
  forget();
  restarted_ = true;
}

void Transforms::forget()
{
  buffer_.clear();
  streams_.clear();
  returned_.clear();
  newest_ = ros::Time();
}

}  // namespace grasp_affordances
