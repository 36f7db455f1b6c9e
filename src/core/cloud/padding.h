#pragma once

#include "grasp_affordances/cloud.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// Points that coincide exactly, by the hundred: what was written for pixels without a measurement, as zeros that were
/// then transformed into another frame. No sensor measures a place that often. Keeps its memory from cloud to cloud.
class Padding
{
public:
  /// So many points at one place are padding. A range image has at most 81 points at one place, each within 4 pixels of
  /// its own.
  static constexpr std::uint32_t kFewest = 100;

  /// Looks through another cloud, in time proportional to its size.
  void find(const Cloud& cloud);

  /// Indices of the points that are padding, in order.
  const std::vector<std::uint32_t>& points() const { return points_; }

  /// How many places there are.
  std::size_t places() const { return places_; }

  /// The place (m) with most points, the first of them where there are several; and their number.
  const Eigen::Vector3f& largestPlace() const { return largest_place_; }
  std::uint32_t pointsAtLargestPlace() const { return points_at_largest_; }

private:
  struct Place
  {
    std::uint32_t first;  // index of its first point
    std::uint32_t points;
  };

  Place& placeOf(const Cloud& cloud, std::uint32_t point);

  std::vector<std::uint32_t> counts_;  // of points, by hash of their coordinates
  std::vector<std::uint32_t> points_;
  std::vector<Place> table_;  // of the places of the points in question, by hash; its size is a power of two
  std::size_t places_ = 0;
  Eigen::Vector3f largest_place_ = Eigen::Vector3f::Zero();
  std::uint32_t points_at_largest_ = 0;
};

}  // namespace grasp_affordances
