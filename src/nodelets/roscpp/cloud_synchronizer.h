#pragma once

#include <message_filters/sync_policies/approximate_time.h>
#include <message_filters/synchronizer.h>
#include <ros/message_traits.h>
#include <ros/time.h>
#include <sensor_msgs/PointCloud2.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace grasp_affordances
{

/// A cloud, and the time by which it is put together with others.
struct TimedCloud
{
  ros::Time time;
  sensor_msgs::PointCloud2ConstPtr cloud;
};

}  // namespace grasp_affordances

namespace ros::message_traits
{

/// For message_filters.
template <>
struct TimeStamp<grasp_affordances::TimedCloud>
{
  static const ros::Time& value(const grasp_affordances::TimedCloud& timed) { return timed.time; }
};

}  // namespace ros::message_traits

namespace grasp_affordances
{

/// Puts the clouds of several cameras together that were measured at about the same time: message_filters'
/// ApproximateTime, for a number of cameras that is known at run time only. A set comes as soon as no cloud still to
/// come could make a better one. Of one thread.
class CloudSynchronizer
{
public:
  using Points = sensor_msgs::PointCloud2ConstPtr;
  using Set = std::vector<Points>;  ///< one of each camera, in their order

  static constexpr std::size_t kMostViews = 8;

  /// @param views  how many cameras, 2 to kMostViews
  /// @param slop   s by which the stamps of a set may differ
  /// @param take   is handed the sets, from within add()
  CloudSynchronizer(std::size_t views, double slop, std::function<void(const Set&)> take);

  /// A cloud of a camera, which are counted from 0, with the time that stands for its stamp. One with a time decades
  /// from the others' has them forgotten; one of the last minute of the 32 bits of a stamp is left out.
  void add(std::size_t view, const Points& cloud, const ros::Time& time);
  void add(std::size_t view, const Points& cloud) { add(view, cloud, cloud->header.stamp); }

  /// Forgets the clouds that wait for others.
  void restart();

private:
  using M = TimedCloud;
  using Policy = message_filters::sync_policies::ApproximateTime<M, M, M, M, M, M, M, M>;
  using Synchronizer = message_filters::Synchronizer<Policy>;

  const std::size_t views_;
  const double slop_;
  const std::function<void(const Set&)> take_;
  std::unique_ptr<Synchronizer> synchronizer_;
  std::optional<ros::Time> first_time_;  // since it began
};

}  // namespace grasp_affordances
