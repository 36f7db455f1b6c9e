#pragma once

#include <memory>
#include <mutex>
#include <shared_mutex>
#include <type_traits>
#include <utility>

namespace grasp_affordances
{

/// Ends callbacks before what they use. A roscpp that is shutting down refuses to unsubscribe: Subscriber, Publisher
/// and ServiceServer then neither wait for a callback under way nor keep the next one from beginning.
///
/// A gate is a class's last member, so that it is the first to go. Safe to use from many threads; a callback must not
/// call another one of the same gate, nor close it.
class CallbackGate
{
public:
  CallbackGate() = default;
  ~CallbackGate() { close(); }
  CallbackGate(const CallbackGate&) = delete;
  CallbackGate& operator=(const CallbackGate&) = delete;

  /// The function as long as the gate is open; then one that does nothing and returns false or nothing.
  template <typename Function>
  auto guarded(Function function) const
  {
    return [state = state_, function = std::move(function)](auto&&... arguments) {
      using Result = std::invoke_result_t<const Function&, decltype(arguments)...>;
      const std::shared_lock<std::shared_mutex> lock(state->mutex);
      return state->open ? function(std::forward<decltype(arguments)>(arguments)...) : Result();
    };
  }

  /// Returns when no callback is under way; none begins any more.
  void close()
  {
    const std::unique_lock<std::shared_mutex> lock(state_->mutex);
    state_->open = false;
  }

private:
  struct State
  {
    std::shared_mutex mutex;
    bool open = true;
  };
  const std::shared_ptr<State> state_ = std::make_shared<State>();  // of the callbacks, too, which may outlive the gate
};

}  // namespace grasp_affordances
