#pragma once

#include "grasp_affordances/cloud.h"

#include <ros/time.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>

#include <functional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// Where the clouds come from that a LocalizingLoop works on: from one camera (SingleCloud) or from several
/// (SynchronizedClouds). It subscribes, unsubscribes and gathers; everything else belongs to the loop.
class CloudInput
{
public:
  /// The messages of one moment: one of each camera, in the order of the cameras.
  using Clouds = std::vector<sensor_msgs::PointCloud2ConstPtr>;

  /// What the loop is told, from the callbacks for clouds, which take turns.
  struct Receiver
  {
    std::function<void(const Clouds&)> receive;          ///< the clouds of a moment have arrived
    std::function<void(const ros::Time&)> time_is_back;  ///< stamps went back to this one
  };

  /// The clouds of one moment, ready to be localized in.
  struct Gathered
  {
    std::vector<Cloud*> clouds;  ///< in the order of the messages; valid until the next call of gather()
    std_msgs::Header header;     ///< common frame of the clouds, and the stamp of the newest
  };

  virtual ~CloudInput() = default;

  /// What a call of ~trigger waits for, in words.
  virtual std::string awaited() const = 0;

  /// Begins to receive. Calls of subscribe() and unsubscribe() come from any thread, one at a time.
  /// @throw ros::Exception where a topic cannot be subscribed to
  virtual void subscribe(const Receiver& receiver) = 0;
  virtual void unsubscribe() = 0;

  /// Ends for good: when it returns no callback is under way, and none begins any more.
  virtual void close() = 0;

  /// Converts the messages of a moment. From one thread: the worker's.
  /// @throw CloudError for a message that is no cloud
  virtual Gathered gather(const Clouds& messages) = 0;
};

}  // namespace grasp_affordances
