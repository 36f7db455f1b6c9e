#include "openni2/device_clock.h"

#include <algorithm>

namespace grasp_affordances
{
namespace
{

constexpr std::int64_t kWindow = 5'000'000'000;           // ns; the estimate is the smallest offset within this time
constexpr std::uint64_t kLatest = 4'000'000'000'000'000;  // us; a later time is invalid and would overflow

}  // namespace

std::int64_t DeviceClock::hostTime(std::uint64_t device_us, std::int64_t arrival_ns)
{
  const std::int64_t device_ns = 1000 * static_cast<std::int64_t>(std::min(device_us, kLatest));
  const bool device_went_on = !last_device_ns_ || device_ns > *last_device_ns_;
  const bool host_went_back = last_arrival_ns_ && arrival_ns < *last_arrival_ns_;
  if (!device_went_on || host_went_back) {
    offsets_.clear();
  }
  if (host_went_back) {
    last_host_ns_.reset();
  }
  last_device_ns_ = device_ns;
  last_arrival_ns_ = arrival_ns;

  const std::int64_t offset_ns = arrival_ns - device_ns;
  while (!offsets_.empty() && offsets_.front().device_ns < device_ns - kWindow) {
    offsets_.pop_front();
  }
  while (!offsets_.empty() && offsets_.back().offset_ns >= offset_ns) {
    offsets_.pop_back();
  }
  offsets_.push_back({device_ns, offset_ns});

  std::int64_t host_ns = device_ns + offsets_.front().offset_ns;
  if (last_host_ns_) {
    host_ns = std::max(host_ns, *last_host_ns_ + 1);
  }
  last_host_ns_ = host_ns;
  return host_ns;
}

}  // namespace grasp_affordances
