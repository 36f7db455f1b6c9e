#include "nodelets/localizer/localizing_loop.h"
#include "nodelets/localizer/single_cloud.h"
#include "nodelets/parameters/parameters_ros.h"

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

namespace grasp_affordances
{

/// Localizes enveloping grasp affordances in the newest of the clouds that arrive.
///
/// Subscribed: see SingleCloud; /tf and /tf_static where a parameter names a frame or clouds are localized in on
/// demand, else from the first call on whose region or sensor names a frame. Published, for every processed cloud, with
/// its stamp and in its frame or the target frame: see LocalizationPublishers. Services: see LocalizingLoop; ~localize
/// is offered. Parameters: see NodeParameters.
class LocalizerNodelet : public nodelet::Nodelet
{
private:
  void onInit() override
  {
    loop_.start(getNodeHandle(), getPrivateNodeHandle(), getName(), [this] {
      LocalizingLoop::Setup setup;
      setup.parameters = nodeParameters(getPrivateNodeHandle());
      setup.input = std::make_unique<SingleCloud>(getNodeHandle(), getName());
      setup.offers_localize = true;
      return setup;
    });
  }

  LocalizingLoop loop_;
};

}  // namespace grasp_affordances

PLUGINLIB_EXPORT_CLASS(grasp_affordances::LocalizerNodelet, nodelet::Nodelet)
