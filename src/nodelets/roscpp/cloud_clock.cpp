#include "nodelets/roscpp/cloud_clock.h"

#include "nodelets/roscpp/ros_time.h"

#include <algorithm>

namespace grasp_affordances
{
namespace
{

double seconds(std::chrono::steady_clock::duration duration)
{
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

CloudClock::Reading CloudClock::read(const ros::Time& stamp, Arrival arrival)
{
  const bool stamped = !stamp.isZero();
  const bool began_anew = any_ && stamped && isEarlier(stamp, latest_, ros::Duration(kDisorder));
  if (!any_ || began_anew) {
    any_ = true;
    counts_arrivals_ = !stamped;
    latest_ = stamp;
    latest_came_ = arrival;
    shift_ = 0.0;
    time_ = latest_time_ = stamped ? stamp.toSec() : seconds(arrival.time_since_epoch());
    return {time_, began_anew};
  }
  if (stamped && stamp > latest_) {
    if (counts_arrivals_) {  // the stamps go on from here
      const double advanced = latest_.isZero() ? 0.0 : stamp.toSec() - latest_.toSec();
      shift_ = std::max(time_, latest_time_ + advanced) - stamp.toSec();
    }
    counts_arrivals_ = false;
    latest_ = stamp;
    latest_came_ = arrival;
    time_ = latest_time_ = std::max(time_, stamp.toSec() + shift_);
    return {time_, false};
  }
  const double waited = seconds(arrival - latest_came_);
  if (!stamped || waited > kDisorder) {
    counts_arrivals_ = true;
    time_ = std::max(time_, latest_time_ + waited);
  }
  return {time_, false};
}

}  // namespace grasp_affordances
