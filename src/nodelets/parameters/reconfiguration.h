#pragma once

#include "grasp_affordances/config.h"
#include "nodelets/roscpp/service_thread.h"

#include <dynamic_reconfigure/Config.h>
#include <ros/node_handle.h>

#include <memory>
#include <mutex>
#include <string>

namespace grasp_affordances
{

/// The name by which dynamic_reconfigure knows a parameter of visitParameters(): its path with '_' for '/'.
std::string flatName(const std::string& path);

/// All parameters of visitParameters(), by flat name. An enumeration is its word, a seed a real number: ROS has
/// integers of 32 bits.
dynamic_reconfigure::Config toReconfigureMessage(const Config& config);

/// Takes over the values that a message holds and leaves the others alone. Does not validate.
/// @throw ParameterError for a word that stands for no value, or a seed that is no whole number
void assign(const dynamic_reconfigure::Config& message, Config& config);

/// The parameters of a node as they are now: those that it was started with, until somebody tunes them by
/// dynamic_reconfigure, below ~reconfigure.
///
/// Numbers outside their range are moved to its nearest end, as dynamic_reconfigure does. A combination that validate()
/// refuses is logged, with the reason, and the values before it are put back and published. What the last run has left
/// below ~reconfigure on the parameter server is overwritten at the start: a node always starts with its own
/// parameters.
class Reconfiguration
{
public:
  static constexpr const char* kNamespace = "reconfigure";

  Reconfiguration();
  ~Reconfiguration();

  /// @param config  what the node was started with, valid
  /// @param logger  name of the logger
  void advertise(const ros::NodeHandle& private_node_handle, const std::string& logger, const Config& config);

  /// Ends the service; the values stay. Returns when the call under way is answered.
  void close();

  /// The values that the next cloud is to be localized with. From any thread.
  Config config() const;

private:
  class Server;

  bool change(dynamic_reconfigure::Config& values);

  std::string logger_;
  mutable std::mutex mutex_;  // guards config_
  Config config_;

  std::unique_ptr<Server> server_;
  ServiceThread thread_;  // last: it stops before the rest goes
};

}  // namespace grasp_affordances
