#pragma once

#include <ros/time.h>

#include <chrono>

namespace grasp_affordances
{

/// The time of clouds, for what compares them: tracking, and putting clouds of several cameras together.
///
/// Stamps that advance are the time. Some do not: drivers that stamp once, a paused simulation, relays, and clouds
/// without a stamp (zero). Where the newest stamp stands still for longer than kDisorder, or is zero, the time of
/// arrival counts instead. Clouds that are older than the newest by up to kDisorder are late, and have its time. An
/// older stamp begins anew: a bag is played again, or a simulation is reset.
///
/// Of one thread.
class CloudClock
{
public:
  using Arrival = std::chrono::steady_clock::time_point;

  struct Reading
  {
    double time;      ///< s since some epoch; not earlier than the reading before unless it began anew
    bool began_anew;  ///< what was learnt from the clouds before is of another run
  };

  /// The time of a cloud with this stamp. Arrivals must not go back.
  Reading read(const ros::Time& stamp, Arrival arrival);

  /// Whether the time of the last cloud was that of its arrival.
  bool countsArrivals() const { return counts_arrivals_; }

private:
  ros::Time latest_;     // stamp; zero: none
  Arrival latest_came_;  // when the stamp last advanced
  double latest_time_ = 0.0;
  double time_ = 0.0;
  double shift_ = 0.0;  // s, from stamps to times: by how much longer stamps stood still than they say
  bool any_ = false;
  bool counts_arrivals_ = false;
};

}  // namespace grasp_affordances
