#include "nodelets/localizer/input_demand.h"

#include "nodelets/roscpp/subscribing.h"

#include <ros/console.h>
#include <ros/exception.h>

#include <utility>

namespace grasp_affordances
{

void InputDemand::open(const std::string& logger, Rules rules)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  logger_ = logger;
  rules_ = std::move(rules);
  open_ = true;
  apply();
}

void InputDemand::update()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  apply();
}

std::string InputDemand::demand(bool needed)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  demanded_ = needed;
  return apply();
}

void InputDemand::close()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  open_ = false;
  apply();
}

std::string InputDemand::apply()
{
  const bool needed = open_ && (!rules_.lazy || demanded_ || (!rules_.on_demand && rules_.anybody_listens()));
  if (needed == subscribed_) {
    return "";
  }
  const std::lock_guard<std::mutex> alone(subscribing());
  if (!needed) {
    subscribed_ = false;
    rules_.unsubscribe();
    return "";
  }
  try {
    rules_.subscribe();
    subscribed_ = true;
    return "";
  } catch (const ros::Exception& error) {  // in a callback of the manager's, which would end with all its nodelets
    rules_.unsubscribe();
    if (missing_inputs_.due()) {
      ROS_ERROR_STREAM_NAMED(logger_, "nothing is localized, for want of input: " << error.what());
    }
    return error.what();
  }
}

}  // namespace grasp_affordances
