#pragma once

#include "grasp_affordances/Localize.h"
#include "grasp_affordances/cloud.h"
#include "grasp_affordances/config.h"
#include "nodelets/localizer/framed_localizer.h"
#include "nodelets/parameters/reconfiguration.h"
#include "nodelets/roscpp/service_thread.h"

#include <ros/node_handle.h>
#include <ros/service_server.h>

#include <functional>
#include <memory>

namespace grasp_affordances
{

/// The service ~localize: localizes in a cloud that a call brings. Calls run in a thread of their own, one after the
/// other, with a localizer of their own, made for the first call.
class LocalizeService
{
public:
  using MakeLocalizer = std::function<std::unique_ptr<FramedLocalizer>(const Config&)>;

  ~LocalizeService() { close(); }

  /// @param reconfiguration  must outlive it, until close() has returned
  void advertise(const ros::NodeHandle& private_node_handle, const Reconfiguration& reconfiguration,
                 MakeLocalizer make_localizer);

  /// Ends the service. Returns when the call under way is answered.
  void close();

private:
  bool call(Localize::Request& request, Localize::Response& response);
  void answer(const Localize::Request& request, Localize::Response& response);

  const Reconfiguration* reconfiguration_ = nullptr;
  MakeLocalizer make_localizer_;
  Cloud cloud_;
  std::unique_ptr<FramedLocalizer> localizer_;  // from the first call on
  ros::ServiceServer server_;
  ServiceThread thread_;  // last: it stops before the rest goes
};

}  // namespace grasp_affordances
