#include "core/cloud/padding.h"

#include "core/parallel/random.h"

#include <algorithm>
#include <cstring>

namespace grasp_affordances
{
namespace
{

std::uint64_t bitsOf(float value)
{
  value += 0.0F;  // the two zeros are equal
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

/// The same for points that coincide.
std::uint64_t hashOf(const Cloud& cloud, std::size_t point)
{
  constexpr std::uint64_t kOdd = 0xD6E8FEB86659FD93U;
  return splitMix64((bitsOf(cloud.x[point]) | bitsOf(cloud.y[point]) << 32U) + kOdd * bitsOf(cloud.z[point]));
}

std::size_t powerOfTwoFrom(std::size_t least)
{
  std::size_t power = 1;
  while (power < least) {
    power *= 2;
  }
  return power;
}

}  // namespace

void Padding::find(const Cloud& cloud)
{
  points_.clear();
  places_ = 0;
  points_at_largest_ = 0;
  if (cloud.size() < kFewest) {
    return;
  }
  // Where few points have the hash of a point, there is no padding at its place.
  constexpr std::size_t kPointsPerCount = 8;
  counts_.assign(powerOfTwoFrom(cloud.size() / kPointsPerCount), 0);
  const auto countOf = [&](std::size_t point) -> std::uint32_t& {
    return counts_[hashOf(cloud, point) & (counts_.size() - 1)];
  };
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.measured(i)) {
      ++countOf(i);
    }
  }
  if (*std::max_element(counts_.begin(), counts_.end()) < kFewest) {
    return;
  }
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.measured(i) && countOf(i) >= kFewest) {
      points_.push_back(static_cast<std::uint32_t>(i));
    }
  }
  table_.assign(powerOfTwoFrom(2 * points_.size()), {0, 0});
  for (const std::uint32_t point : points_) {
    ++placeOf(cloud, point).points;
  }
  const auto end = std::remove_if(points_.begin(), points_.end(), [&](std::uint32_t point) {
    const Place& place = placeOf(cloud, point);
    if (place.first == point && place.points >= kFewest) {
      ++places_;
      if (place.points > points_at_largest_) {
        points_at_largest_ = place.points;
        largest_place_ = cloud.point(point);
      }
    }
    return place.points < kFewest;
  });
  points_.erase(end, points_.end());
}

/// The place of a point, or a free one, with no points, that begins with it.
Padding::Place& Padding::placeOf(const Cloud& cloud, std::uint32_t point)
{
  constexpr unsigned kOtherBits = 32;  // than those that counts_ goes by
  std::size_t i = (hashOf(cloud, point) >> kOtherBits) & (table_.size() - 1);
  while (table_[i].points > 0 && cloud.point(table_[i].first) != cloud.point(point)) {
    i = (i + 1) & (table_.size() - 1);
  }
  if (table_[i].points == 0) {
    table_[i].first = point;
  }
  return table_[i];
}

}  // namespace grasp_affordances
