#include "nodelets/selection/handle_display.h"

#include <visualization_msgs/InteractiveMarkerFeedback.h>

#include <utility>

namespace grasp_affordances
{

using visualization_msgs::InteractiveMarker;
using visualization_msgs::InteractiveMarkerFeedback;

namespace
{

constexpr bool kThreadOfItsOwn = true;  // joined before the server's topics go

}  // namespace

HandleDisplay::HandleDisplay(const std::string& topic, Feedback feedback)
    : feedback_(std::move(feedback)),
      server_(std::make_unique<interactive_markers::InteractiveMarkerServer>(topic, "", kThreadOfItsOwn)),
      worker_(std::make_unique<NewestOnlyWorker<Scene>>([this](const Scene& scene) { draw(scene); }))
{
}

void HandleDisplay::close()
{
  worker_->stop();
  server_.reset();
}

void HandleDisplay::draw(const Scene& scene)
{
  Markers wanted;
  for (const GraspHandle& handle : scene.handles) {
    const bool selected = handle.id == scene.selected;
    InteractiveMarker marker =
        handleMarker(handle, scene.header, selected, selected ? scene.hand : std::nullopt, scene.geometry);
    InteractiveMarker look = marker;
    look.header = std_msgs::Header();
    look.pose = geometry_msgs::Pose();
    const auto shown = shown_.find(marker.name);
    if (shown != shown_.end() && shown->second == look) {
      server_->setPose(marker.name, marker.pose, marker.header);  // a viewer rebuilds nothing
    } else {
      server_->insert(marker, [this, id = handle.id](const visualization_msgs::InteractiveMarkerFeedbackConstPtr& f) {
        receive(id, *f);
      });
    }
    wanted.emplace(marker.name, std::move(look));
  }
  for (const auto& [name, look] : shown_) {
    if (wanted.count(name) == 0) {
      server_->erase(name);
    }
  }
  server_->applyChanges();
  shown_ = std::move(wanted);
}

void HandleDisplay::receive(std::uint32_t id, const InteractiveMarkerFeedback& feedback) const
{
  if (feedback.event_type == InteractiveMarkerFeedback::BUTTON_CLICK) {
    feedback_(id, std::nullopt);
  } else if (feedback.event_type == InteractiveMarkerFeedback::MENU_SELECT) {
    feedback_(id, static_cast<HandleMenu>(feedback.menu_entry_id));
  }
}

}  // namespace grasp_affordances
