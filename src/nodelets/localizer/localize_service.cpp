#include "nodelets/localizer/localize_service.h"

#include <tf2/exceptions.h>

#include <exception>
#include <string>
#include <utility>

namespace grasp_affordances
{

void LocalizeService::advertise(const ros::NodeHandle& private_node_handle, Answer answer)
{
  answer_ = std::move(answer);
  server_ = thread_.nodeHandle(private_node_handle).advertiseService("localize", &LocalizeService::call, this);
  thread_.start();
}

void LocalizeService::close()
{
  thread_.stop();
  server_.shutdown();
}

bool LocalizeService::call(Localize::Request& request, Localize::Response& response)
{
  try {
    answer_(request, response);
    response.success = true;
    response.message = response.statistics.explanation;
  } catch (const std::exception& error) {  // also no memory for what a cloud asks for
    response = Localize::Response();
    response.success = false;
    response.message = error.what();
  }
  return true;
}

}  // namespace grasp_affordances
