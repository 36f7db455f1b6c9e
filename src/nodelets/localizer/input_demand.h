#pragma once

#include "nodelets/roscpp/throttle.h"

#include <functional>
#include <mutex>
#include <string>

namespace grasp_affordances
{

/// Whether a node needs its inputs: it subscribes to them when somebody begins to need them, and unsubscribes when
/// nobody does any more. Every method may be called from any thread.
class InputDemand
{
public:
  struct Rules
  {
    bool lazy = true;                       ///< false: the inputs are always needed
    bool on_demand = false;                 ///< listeners need no inputs, only demand() does
    std::function<bool()> anybody_listens;  ///< to an output
    std::function<void()> subscribe;        ///< to the inputs; may throw ros::Exception
    std::function<void()> unsubscribe;      ///< also called where `subscribe` has thrown
  };

  /// Begins. Until then update() does nothing, so that connections to outputs that are just being advertised do no
  /// harm. `subscribe` and `unsubscribe` are called from any thread, one at a time. Where `subscribe` throws a
  /// ros::Exception, that is logged under the logger's name, and it is tried again at the next call of update().
  void open(const std::string& logger, Rules rules);

  /// The listeners have changed.
  void update();

  /// Whether the inputs are needed, whoever listens.
  /// @return why they cannot be had; empty where they can
  std::string demand(bool needed);

  /// Unsubscribes for good.
  void close();

private:
  std::string apply();  // returns why the inputs cannot be had

  std::mutex mutex_;  // guards all
  std::string logger_;
  Rules rules_;
  bool open_ = false;  // a connection that is under way at the end must not subscribe again
  bool demanded_ = false;
  bool subscribed_ = false;
  Throttle missing_inputs_;
};

}  // namespace grasp_affordances
