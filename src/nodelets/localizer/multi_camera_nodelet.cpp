#include "nodelets/localizer/localizing_loop.h"
#include "nodelets/localizer/synchronized_clouds.h"
#include "nodelets/parameters/parameters_ros.h"

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

namespace grasp_affordances
{

/// Localizes enveloping grasp affordances in what several cameras see at the same time, in a common frame: the newest
/// set of clouds, one of each camera, whose stamps differ by little.
///
/// Subscribed: see SynchronizedClouds; /tf and /tf_static, which must lead from the target frame to each cloud's at its
/// stamp. Published, for every processed set, in the target frame and with the stamp of the newest cloud: see
/// LocalizationPublishers. Services: see LocalizingLoop; a call of ~trigger waits for a set of clouds.
/// Parameters: see MultiCameraParameters.
class MultiCameraNodelet : public nodelet::Nodelet
{
private:
  void onInit() override
  {
    loop_.start(getNodeHandle(), getPrivateNodeHandle(), getName(), [this] {
      const MultiCameraParameters parameters = multiCameraParameters(getPrivateNodeHandle());
      LocalizingLoop::Setup setup;
      setup.parameters = parameters.node;
      setup.input = std::make_unique<SynchronizedClouds>(getNodeHandle(), getName(), parameters);
      setup.always_listens_to_tf = true;
      return setup;
    });
  }

  LocalizingLoop loop_;
};

}  // namespace grasp_affordances

PLUGINLIB_EXPORT_CLASS(grasp_affordances::MultiCameraNodelet, nodelet::Nodelet)
