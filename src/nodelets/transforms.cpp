#include "nodelets/transforms.h"

#include <tf2_eigen/tf2_eigen.h>

#include <cstdint>

namespace grasp_affordances
{
namespace
{

constexpr std::uint32_t kSubscriberQueue = 100;
constexpr std::uint32_t kThreads = 1;

/// tf2 knows no leading slash, with which older drivers and bags name their frames.
std::string frameName(const std::string& name)
{
  return !name.empty() && name[0] == '/' ? name.substr(1) : name;
}

}  // namespace

Transforms::Transforms(ros::NodeHandle& node_handle) : spinner_(kThreads, &queue_)
{
  using Event = ros::MessageEvent<const tf2_msgs::TFMessage>;
  const auto subscribe = [&](const std::string& topic, bool fixed) {
    ros::SubscribeOptions options;
    options.initByFullCallbackType<const Event&>(topic, kSubscriberQueue,
                                                 [this, fixed](const Event& event) { receive(event, fixed); });
    options.callback_queue = &queue_;
    return node_handle.subscribe(options);
  };
  moving_ = subscribe("/tf", false);
  fixed_ = subscribe("/tf_static", true);
  spinner_.start();
}

Eigen::Isometry3d Transforms::lookup(const std::string& target_frame, const std::string& source_frame,
                                     const ros::Time& stamp, std::chrono::duration<double> timeout)
{
  const std::string target = frameName(target_frame);
  const std::string source = frameName(source_frame);
  if (target == source) {
    return Eigen::Isometry3d::Identity();
  }
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, timeout, [&] { return closed_ || buffer_.canTransform(target, source, stamp); });
  return tf2::transformToEigen(buffer_.lookupTransform(target, source, stamp));
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
  for (const geometry_msgs::TransformStamped& transform : event.getMessage()->transforms) {
    const ros::Time& stamp = transform.header.stamp;
    if (!fixed && streams_[transform.child_frame_id].wentBack(stamp)) {
      forget();
      restarted_ = true;
      streams_[transform.child_frame_id].wentBack(stamp);
    }
    buffer_.setTransform(transform, event.getPublisherName(), fixed);
  }
  changed_.notify_all();
}

void Transforms::forget()
{
  buffer_.clear();
  streams_.clear();
}

}  // namespace grasp_affordances
