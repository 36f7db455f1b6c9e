#include "nodelets/localizer/trigger_service.h"

#include "nodelets/messages/region_of_interest.h"

#include <ros/init.h>

#include <exception>
#include <sstream>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr double kTimeout = 5.0;                        // s, where a call gives none
constexpr double kLongestTimeout = 3600;                // s
constexpr std::chrono::milliseconds kShutdownPoll{50};  // nothing tells a service of the end of its node

LocalizeNext::Response failure(const std::string& reason)
{
  LocalizeNext::Response response;
  response.success = false;
  response.message = reason;
  return response;
}

std::string refusal(double timeout)
{
  std::ostringstream text;
  text << "timeout: " << timeout << " is outside the allowed range [0, " << kLongestTimeout << "] s";
  return text.str();
}

}  // namespace

void TriggerService::advertise(const ros::NodeHandle& private_node_handle, const std::string& awaited,
                               std::function<std::string(bool)> demand)
{
  awaited_ = awaited;
  demand_ = std::move(demand);
  server_ = thread_.nodeHandle(private_node_handle).advertiseService("trigger", &TriggerService::call, this);
  thread_.start();
}

void TriggerService::close()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
  thread_.stop();
  thread_.end(server_);
}

bool TriggerService::arrives(Clock::time_point arrival)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (state_ != State::waiting) {
    return false;
  }
  state_ = State::arrived;
  arrival_ = arrival;
  return true;
}

std::optional<RegionOfInterest> TriggerService::take(Clock::time_point arrival)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (state_ != State::arrived || arrival < arrival_) {
    return std::nullopt;
  }
  state_ = State::taken;
  return region_;
}

void TriggerService::answer(const LocalizationPublishers::Messages& messages)
{
  LocalizeNext::Response response;
  response.success = true;
  response.message = messages.statistics->explanation;
  response.shells = messages.shells->shells;
  response.handles = messages.handles->handles;
  response.statistics = *messages.statistics;
  finish(std::move(response));
}

void TriggerService::fail(const std::string& reason)
{
  finish(failure(reason));
}

void TriggerService::finish(LocalizeNext::Response response)
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (state_ != State::taken) {
      return;
    }
    state_ = State::answered;
    response_ = std::move(response);
  }
  changed_.notify_all();
}

bool TriggerService::call(LocalizeNext::Request& request, LocalizeNext::Response& response)
{
  if (!(request.timeout >= 0.0 && request.timeout <= kLongestTimeout)) {
    response = failure(refusal(request.timeout));
    return true;
  }
  try {
    withRegion(Config(), request.region);
  } catch (const ParameterError& error) {
    response = failure(error.what());
    return true;
  }
  response = waitForAnswer(request.region, request.timeout > 0.0 ? request.timeout : kTimeout);
  return true;
}

LocalizeNext::Response TriggerService::waitForAnswer(const RegionOfInterest& region, double timeout)
{
  const auto deadline =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout));
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    state_ = State::waiting;
    region_ = region;
  }
  const std::string refusal = demand_(true);
  LocalizeNext::Response response;
  {
    std::unique_lock<std::mutex> lock(mutex_);
    const auto ends = [&] { return closed_ || ros::isShuttingDown(); };
    const auto late = [&] { return state_ == State::waiting && Clock::now() >= deadline; };
    while (refusal.empty() && state_ != State::answered && !ends() && !late()) {
      changed_.wait_for(lock, kShutdownPoll);
    }
    if (state_ == State::answered) {
      response = std::move(response_);
    } else if (ends()) {
      response = failure("the node ends");
    } else if (!refusal.empty()) {
      response = failure("no clouds can be had: " + refusal);
    } else {
      std::ostringstream text;
      text << "no " << awaited_ << " arrived within " << timeout << " s";
      response = failure(text.str());
    }
    state_ = State::idle;
  }
  demand_(false);
  return response;
}

}  // namespace grasp_affordances
