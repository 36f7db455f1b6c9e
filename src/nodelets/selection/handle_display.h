#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/handle.h"
#include "nodelets/messages/handle_markers.h"
#include "nodelets/roscpp/newest_only_worker.h"

#include <interactive_markers/interactive_marker_server.h>
#include <std_msgs/Header.h>
#include <visualization_msgs/InteractiveMarker.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// Shows handles as interactive markers and tells what an operator does with them.
///
/// The server of interactive_markers calls feedback back while it holds the mutex that its insert() and applyChanges()
/// need as well: who calls those under a lock that the feedback waits for, deadlocks. So they are called in a thread of
/// its own here, without any lock, and always with the newest scene; show() only leaves it there.
class HandleDisplay
{
public:
  struct Scene
  {
    std_msgs::Header header;
    std::vector<GraspHandle> handles;
    std::uint32_t selected = 0;     ///< id; 0: none
    std::optional<GraspPose> hand;  ///< at the selected handle, of the hand, not of a tool
    HandGeometry geometry;
  };

  /// What an operator did with the handle of that id; a click is nothing. From the server's thread.
  using Feedback = std::function<void(std::uint32_t id, std::optional<HandleMenu> entry)>;

  /// @param topic  resolved; a viewer listens to TOPIC/update
  HandleDisplay(const std::string& topic, Feedback feedback);
  ~HandleDisplay() { close(); }

  /// Shows this and nothing else. From any thread; returns at once. Ignored after close().
  void show(Scene scene) { worker_->put(std::move(scene)); }

  /// Removes everything and takes the topics down. No feedback comes after it.
  void close();

private:
  using Markers = std::map<std::string, visualization_msgs::InteractiveMarker>;  // by name, without header and pose

  void draw(const Scene& scene);
  void receive(std::uint32_t id, const visualization_msgs::InteractiveMarkerFeedback& feedback) const;

  const Feedback feedback_;
  std::unique_ptr<interactive_markers::InteractiveMarkerServer> server_;
  Markers shown_;  // of the worker's thread
  std::unique_ptr<NewestOnlyWorker<Scene>> worker_;
};

}  // namespace grasp_affordances
