#pragma once

#include <message_filters/sync_policies/approximate_time.h>
#include <message_filters/synchronizer.h>
#include <ros/time.h>
#include <sensor_msgs/PointCloud2.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

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

  /// A cloud of a camera, which are counted from 0. One with a stamp decades from the others' has them forgotten; one
  /// of the last minute of their 32 bits is left out.
  void add(std::size_t view, const Points& cloud);

  /// Forgets the clouds that wait for others.
  void restart();

private:
  using M = sensor_msgs::PointCloud2;
  using Policy = message_filters::sync_policies::ApproximateTime<M, M, M, M, M, M, M, M>;
  using Synchronizer = message_filters::Synchronizer<Policy>;

  const std::size_t views_;
  const double slop_;
  const std::function<void(const Set&)> take_;
  std::unique_ptr<Synchronizer> synchronizer_;
  std::optional<ros::Time> first_stamp_;  // since it began
};

}  // namespace grasp_affordances
