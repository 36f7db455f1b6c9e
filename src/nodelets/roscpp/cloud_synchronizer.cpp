#include "nodelets/roscpp/cloud_synchronizer.h"

#include "nodelets/roscpp/ros_time.h"

#include <ros/duration.h>
#include <boost/function.hpp>
#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>

#include <array>
#include <cstdint>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr std::uint32_t kQueue = 10;  // clouds per camera

/// s; depth cameras deliver no more than 60 clouds per second. Without that the synchronizer would have to wait for the
/// next cloud of each camera before it knew that a set is the best.
constexpr double kLeastPeriod = 0.015;

/// s from the first stamp, before or after it. The synchronizer computes with 1.1 of the differences between stamps,
/// and roscpp's throw at 2^31 s.
constexpr std::int64_t kLongestBetween = std::int64_t{1} << 29;

bool areFarApart(const ros::Time& a, const ros::Time& b)
{
  const std::int64_t difference = std::int64_t{a.sec} - std::int64_t{b.sec};
  return difference > kLongestBetween || difference < -kLongestBetween;
}

template <typename Synchronizer, int input>
void addTo(Synchronizer& synchronizer, const boost::shared_ptr<const TimedCloud>& cloud)
{
  synchronizer.template add<input>(cloud);
}

template <typename Synchronizer, int... inputs>
constexpr auto adders(std::integer_sequence<int, inputs...> /*unused*/)
{
  return std::array{&addTo<Synchronizer, inputs>...};
}

}  // namespace

CloudSynchronizer::CloudSynchronizer(std::size_t views, double slop, std::function<void(const Set&)> take)
    : views_(views), slop_(slop), take_(std::move(take))
{
  restart();
}

void CloudSynchronizer::add(std::size_t view, const Points& cloud, const ros::Time& time)
{
  static constexpr auto kAdders = adders<Synchronizer>(std::make_integer_sequence<int, kMostViews>());
  if (!leavesRoom(time)) {
    return;  // it adds to stamps, too
  }
  if (first_time_ && areFarApart(time, *first_time_)) {
    restart();
  }
  first_time_ = first_time_.value_or(time);
  const auto timed = boost::make_shared<const TimedCloud>(TimedCloud{time, cloud});
  kAdders[view](*synchronizer_, timed);
  if (view == 0) {
    for (std::size_t unused = views_; unused < kMostViews; ++unused) {
      kAdders[unused](*synchronizer_, timed);
    }
  }
}

void CloudSynchronizer::restart()
{
  using P = const boost::shared_ptr<const TimedCloud>&;
  using Nothing = const boost::shared_ptr<const message_filters::NullType>&;
  first_time_.reset();
  synchronizer_ = std::make_unique<Synchronizer>(Policy(kQueue));
  synchronizer_->setMaxIntervalDuration(ros::Duration(slop_));
  synchronizer_->setInterMessageLowerBound(ros::Duration(kLeastPeriod));
  boost::function<void(P, P, P, P, P, P, P, P, Nothing)> receive = [this](P a, P b, P c, P d, P e, P f, P g, P h,
                                                                          Nothing) {
    Set set{a->cloud, b->cloud, c->cloud, d->cloud, e->cloud, f->cloud, g->cloud, h->cloud};
    set.resize(views_);
    take_(set);
  };
  synchronizer_->registerCallback(receive);
}

}  // namespace grasp_affordances
