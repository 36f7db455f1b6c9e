#pragma once

#include "grasp_affordances/Localize.h"
#include "nodelets/roscpp/service_thread.h"

#include <ros/node_handle.h>
#include <ros/service_server.h>

#include <functional>

namespace grasp_affordances
{

/// The service ~localize: localizes in a cloud that a call brings. Calls run in a thread of their own, one after the
/// other.
class LocalizeService
{
public:
  using Answer = std::function<void(const Localize::Request&, Localize::Response&)>;

  ~LocalizeService() { close(); }

  /// @param answer  fills in shells, handles and statistics; what it throws is answered with success = false. It is
  /// called
  ///                in the service's thread
  void advertise(const ros::NodeHandle& private_node_handle, Answer answer);

  /// Ends the service. Returns when the call under way is answered.
  void close();

private:
  bool call(Localize::Request& request, Localize::Response& response);

  Answer answer_;
  ros::ServiceServer server_;
  ServiceThread thread_;  // last: it stops before the rest goes
};

}  // namespace grasp_affordances
