#pragma once

#include "grasp_affordances/BestHandle.h"
#include "grasp_affordances/SelectHandle.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/handle.h"
#include "nodelets/roscpp/callback_gate.h"
#include "nodelets/roscpp/ros_time.h"
#include "nodelets/roscpp/service_thread.h"
#include "nodelets/selection/hand_pose_choice.h"
#include "nodelets/selection/handle_display.h"

#include <geometry_msgs/PoseStamped.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/service_server.h>
#include <std_msgs/Header.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// Lets an operator or a program choose one of the known handles, and follows it by its id.
///
/// Published, both latched, when the selection changes and with every cloud while there is one: ~selected (Handle; id 0
/// when there is none any more) and ~selected_pose (geometry_msgs/PoseStamped: the chosen hand pose, where the handle
/// has any). Interactive markers for rviz: ~handles_interactive/update. Services: ~select (SelectHandle), ~best
/// (BestHandle); they answer from the newest cloud, and refuse where that came too long ago.
///
/// Without tracking an id is a handle's place by score in one cloud, and following it means little.
class HandleSelection
{
public:
  ~HandleSelection() { close(); }

  /// @param max_age  s since the newest cloud arrived, beyond which its handles are refused; 0: no limit
  /// @param listeners_changed  called, from any thread, when somebody begins or ceases to listen
  void advertise(ros::NodeHandle& private_node_handle, const std::string& name, double max_age,
                 const std::function<void()>& listeners_changed);

  /// Whether anybody listens to the selection or to the interactive markers.
  bool anybodyListens() const;

  /// The handles that are known after a cloud; replaces all others. Of one thread.
  /// @param arrival  of the cloud
  void update(const std::vector<GraspHandle>& handles, const Config& config, const std_msgs::Header& header,
              const Moment& arrival);

  /// Takes the services and the interactive markers down. The topics of the selection remain: an update may still come.
  void close();

private:
  // With mutex_ held.
  const GraspHandle* find(std::uint32_t id) const;
  const GraspHandle* best() const;
  double age() const;
  std::string whyTooOld() const;
  std::string knownIds() const;
  void select(const GraspHandle& handle);
  void deselect();
  void showSelection();
  void publish(const GraspHandle& handle);
  void chooseHandPose(std::optional<std::size_t> index, const GraspHandle& handle);
  geometry_msgs::PoseStamped handPose(const GraspHandle& handle, std::size_t index) const;

  void act(std::uint32_t id, std::optional<HandleMenu> entry);
  bool answerSelect(SelectHandle::Request& request, SelectHandle::Response& response);
  bool answerBest(BestHandle::Request& request, BestHandle::Response& response);

  std::string name_;
  double max_age_ = 0.0;  // s
  ros::Publisher selected_publisher_;
  ros::Publisher selected_pose_publisher_;
  ros::Publisher interactive_update_;  // besides that of the server, which does not tell who listens
  ros::ServiceServer select_service_;
  ros::ServiceServer best_service_;
  std::unique_ptr<HandleDisplay> display_;

  // Results come from the worker's thread, feedback from the display's and calls from that of the services. All of them
  // read and change the selection and publish it, and must do so in one order. Nothing that is called with it
  // held waits for any of those threads.
  std::mutex mutex_;
  std::optional<Moment> arrival_;  // of the newest cloud
  std_msgs::Header header_;
  std::vector<GraspHandle> handles_;
  HandGeometry geometry_;
  Eigen::Isometry3d T_hand_tool_ = Eigen::Isometry3d::Identity();
  std::uint32_t selected_ = 0;  // id; 0: none
  HandPoseChoice choice_;
  std::optional<std::size_t> hand_pose_;  // index of the chosen one
  bool complained_ = false;               // that the selected handle has none

  CallbackGate gate_;     // of calls
  ServiceThread thread_;  // last: it stops before the rest goes
};

}  // namespace grasp_affordances
