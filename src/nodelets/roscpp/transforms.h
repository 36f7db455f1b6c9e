#pragma once

#include "nodelets/roscpp/ros_time.h"
#include "nodelets/roscpp/throttle.h"

#include <geometry_msgs/TransformStamped.h>
#include <ros/callback_queue.h>
#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <ros/subscriber.h>
#include <ros/time.h>
#include <ros/wall_timer.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>
#include <Eigen/Geometry>

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <set>
#include <string>

namespace grasp_affordances
{

/// Transforms between frames, from /tf and /tf_static. They arrive in a thread of their own: another one may wait for
/// them, also in a callback. Every method may be called from any thread.
///
/// In place of tf2_ros::TransformListener, which forgets what it knows when the ROS clock is set back: with a looping
/// bag that happens after the first transforms of the new round have arrived, and they would be lost (see TimeJumps).
/// Its Buffer waits by the ROS clock, which may stand still. Here all is forgotten as soon as the ROS clock goes back
/// to before what is known, or the stamps of a frame that lookup() was asked for go back. Frames that nobody asked for
/// have no say: two publishers with different clocks may share one of them. When lookup() is first asked for one whose
/// stamps went back before, all is forgotten then.
class Transforms
{
public:
  using Deadline = std::chrono::steady_clock::time_point;

  /// So many seconds from now.
  static Deadline after(double seconds)
  {
    return std::chrono::steady_clock::now() +
           std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
  }

  /// Names are remapped as those of the node handle.
  explicit Transforms(const ros::NodeHandle& node_handle);
  ~Transforms();

  /// Subscribes. Of what was published before, only the fixed transforms will be known.
  void listen();

  /// The transform at the time of the stamp (zero: the latest), interpolated; of a frame to itself the identity. Waits
  /// for it, by the wall clock. Between other frames the first call listens.
  /// @throw tf2::TransformException, with the reason, where it has not arrived by the deadline, close() or the end of
  /// the node.
  Eigen::Isometry3d lookup(const std::string& target_frame, const std::string& source_frame, const ros::Time& stamp,
                           Deadline deadline);

  /// Where the stamps of the data to be transformed went back: forgets the moving transforms, unless these, or the ROS
  /// clock, went back on their own account since the last call.
  void restart();

  /// Ends every wait, for good.
  void close();

private:
  void receive(const ros::MessageEvent<const tf2_msgs::TFMessage>& event, bool fixed);
  bool wentBack(const geometry_msgs::TransformStamped& transform);
  void lookAtClock();
  void remember(const std::string& target, const std::string& source, const ros::Time& stamp);
  void startAgain(const std::string& frame, const ros::Time& stamp);
  void forget();

  std::mutex mutex_;  // guards the following
  std::condition_variable changed_;
  tf2::BufferCore buffer_;
  std::map<std::string, TimeJumps> streams_;   // of the moving transforms, by child frame
  std::set<std::string> asked_;                // child frames between those that lookup() was asked for
  std::map<std::string, ros::Time> returned_;  // of other child frames: the stamps that they went back to
  ros::Time newest_;                           // of the moving transforms
  ros::Time clock_;                            // the ROS clock when it was last looked at, where it is simulated
  Throttle refusals_;
  Throttle restarts_;
  bool restarted_ = false;
  bool closed_ = false;

  std::mutex listening_mutex_;  // guards the subscribers
  ros::NodeHandle node_handle_;
  ros::CallbackQueue queue_;
  ros::Subscriber moving_;
  ros::Subscriber fixed_;
  ros::WallTimer clock_watch_;
  ros::AsyncSpinner spinner_;
};

}  // namespace grasp_affordances
