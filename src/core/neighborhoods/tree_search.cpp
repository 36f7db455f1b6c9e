#include "core/neighborhoods/tree_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace grasp_affordances
{
namespace
{

constexpr std::size_t kLeaf = 64;         // most points of a leaf
constexpr std::size_t kSharedLevels = 6;  // the nodes of this level are worked on side by side
constexpr std::size_t kBlocks = 64;       // of the cloud's points, for work that is shared
constexpr std::size_t kMostLevels = 32;   // indices have 32 bits

/// Where a sphere holds a larger part of the cloud, the whole cloud is gone through instead: that needs no sorting.
constexpr std::size_t kCrowd = 8;

/// Calls task(i) for every i < count.
template <typename Task>
void share(std::size_t count, ThreadTeam* team, Task&& task)
{
  if (team != nullptr) {
    team->forEach(count, [&](std::size_t i, std::size_t) { task(i); });
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    task(i);
  }
}

}  // namespace

double TreeSearch::Box::squaredDistance(const Eigen::Vector3f& place) const
{
  double squared = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double p = place[axis];
    const double distance = std::max(0.0, std::max(low[axis] - p, p - high[axis]));
    squared += distance * distance;
  }
  return squared;
}

double TreeSearch::Box::squaredFarthestDistance(const Eigen::Vector3f& place) const
{
  double squared = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double p = place[axis];
    const double distance = std::max(std::abs(low[axis] - p), std::abs(high[axis] - p));
    squared += distance * distance;
  }
  return squared;
}

TreeSearch::Range TreeSearch::rangeOf(const Node& node) const
{
  return {(index_.size() * node.number) >> node.level, (index_.size() * (node.number + 1)) >> node.level};
}

void TreeSearch::update(const Cloud& cloud, ThreadTeam* team)
{
  cloud_ = &cloud;
  listPoints(cloud, team);
  levels_ = 0;
  while ((index_.size() >> levels_) > kLeaf) {
    ++levels_;
  }
  boxes_.resize((std::size_t{2} << levels_) - 1);
  const std::size_t shared = std::min(levels_, kSharedLevels);
  for (std::size_t level = 0; level < shared; ++level) {
    share(std::size_t{1} << level, team, [&](std::size_t number) { split({level, number}); });
  }
  share(std::size_t{1} << shared, team, [&](std::size_t number) { splitAll({shared, number}); });
  storePoints(team);
}

/// Lists the measured points, in the order of the cloud.
void TreeSearch::listPoints(const Cloud& cloud, ThreadTeam* team)
{
  std::array<std::size_t, kBlocks + 1> first{};
  const auto blockBegin = [&](std::size_t block) { return cloud.size() * block / kBlocks; };
  share(kBlocks, team, [&](std::size_t block) {
    std::size_t count = 0;
    for (std::size_t i = blockBegin(block); i < blockBegin(block + 1); ++i) {
      count += cloud.measured(i) ? 1 : 0;
    }
    first[block + 1] = count;
  });
  std::partial_sum(first.begin(), first.end(), first.begin());
  points_.resize(first.back());
  index_.resize(first.back());
  share(kBlocks, team, [&](std::size_t block) {
    std::size_t place = first[block];
    for (std::size_t i = blockBegin(block); i < blockBegin(block + 1); ++i) {
      if (cloud.measured(i)) {
        points_[place++] = {{cloud.x[i], cloud.y[i], cloud.z[i]}, static_cast<std::uint32_t>(i)};
      }
    }
  });
}

/// Finds the box of a node's points. Where it is no leaf, divides them at the median of the box's longest side.
void TreeSearch::split(const Node& node)
{
  const Range range = rangeOf(node);
  Box& box = boxOf(node);
  std::fill_n(box.low, 3, std::numeric_limits<float>::infinity());
  std::fill_n(box.high, 3, -std::numeric_limits<float>::infinity());
  for (std::size_t i = range.begin; i < range.end; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], points_[i].at[axis]);
      box.high[axis] = std::max(box.high[axis], points_[i].at[axis]);
    }
  }
  if (node.level == levels_) {
    return;
  }
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis) {
    longest = box.high[axis] - box.low[axis] > box.high[longest] - box.low[longest] ? axis : longest;
  }
  const auto at = [&](std::size_t place) { return points_.begin() + static_cast<std::ptrdiff_t>(place); };
  std::nth_element(at(range.begin), at(rangeOf({node.level + 1, 2 * node.number}).end), at(range.end),
                   [longest](const Point& a, const Point& b) { return a.at[longest] < b.at[longest]; });
}

/// Splits a node and all nodes below it.
void TreeSearch::splitAll(const Node& node)
{
  split(node);
  if (node.level < levels_) {
    splitAll({node.level + 1, 2 * node.number});
    splitAll({node.level + 1, 2 * node.number + 1});
  }
}

void TreeSearch::storePoints(ThreadTeam* team)
{
  const std::size_t count = points_.size();
  // The kernels read whole registers, also at the end.
  leaves_.width = static_cast<std::uint32_t>(count + kGatherSlack);
  leaves_.height = 1;
  for (std::vector<float>* coordinates : {&leaves_.x, &leaves_.y, &leaves_.z}) {
    coordinates->resize(count + kGatherSlack);
    std::fill_n(coordinates->end() - kGatherSlack, kGatherSlack, std::nanf(""));
  }
  share(kBlocks, team, [&](std::size_t block) {
    for (std::size_t i = count * block / kBlocks; i < count * (block + 1) / kBlocks; ++i) {
      leaves_.x[i] = points_[i].at[0];
      leaves_.y[i] = points_[i].at[1];
      leaves_.z[i] = points_[i].at[2];
      index_[i] = points_[i].index;
    }
  });
}

/// Lists the leaves that hold points of a sphere, neighbors as one range.
/// @return how many points they hold
std::size_t TreeSearch::findRanges(const Eigen::Vector3f& center, float radius, std::vector<Range>& ranges) const
{
  // The sphere is that of Neighborhood, which computes in single precision. In exact numbers it may be a little larger.
  constexpr double kRounding = 1.0 + 1e-6, kUnderflow = 1e-37;
  const double squared_radius = static_cast<double>(radius * radius);
  const double limit = kRounding * squared_radius + kUnderflow;
  ranges.clear();
  std::size_t points = 0;
  std::array<Node, kMostLevels + 1> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {0, 0};
  while (waiting > 0) {
    const Node node = stack[--waiting];
    const Box& box = boxOf(node);
    if (box.squaredDistance(center) > limit) {
      continue;
    }
    if (node.level < levels_ && box.squaredFarthestDistance(center) > squared_radius) {
      stack[waiting++] = {node.level + 1, 2 * node.number + 1};
      stack[waiting++] = {node.level + 1, 2 * node.number};
      continue;
    }
    const Range range = rangeOf(node);
    points += range.end - range.begin;
    if (!ranges.empty() && ranges.back().end == range.begin) {
      ranges.back().end = range.end;
    } else {
      ranges.push_back(range);
    }
  }
  return points;
}

void TreeSearch::withinRadius(const Eigen::Vector3f& center, float radius, Neighborhood& result) const
{
  static thread_local std::vector<Range> ranges;
  static thread_local Neighborhood found;
  result.clear(center, radius);
  if (index_.empty() || !center.allFinite()) {
    return;
  }
  if (findRanges(center, radius, ranges) > cloud_->size() / kCrowd) {
    result.appendRange(*cloud_, 0, cloud_->size());
    return;
  }
  found.clear(center, radius);
  for (const Range& range : ranges) {
    found.appendRange(leaves_, range.begin, range.end);
  }
  result.appendRenumbered(found, index_.data());
}

/// A node that holds k points, near the centre, tells a radius within which there are as many.
void TreeSearch::nearest(const Eigen::Vector3f& center, std::size_t k, Neighborhood& result) const
{
  k = center.allFinite() ? std::min(k, index_.size()) : 0;
  if (k == 0) {
    result.clear(center, 0.0F);
    result.keepNearest(0);
    return;
  }
  const auto size = [this](const Node& node) { return rangeOf(node).end - rangeOf(node).begin; };
  Node node{0, 0};
  while (node.level < levels_) {
    const Node first{node.level + 1, 2 * node.number}, second{node.level + 1, 2 * node.number + 1};
    const bool first_is_nearer = boxOf(first).squaredDistance(center) <= boxOf(second).squaredDistance(center);
    const Node& nearer = first_is_nearer ? first : second;
    if (size(nearer) < k) {
      break;
    }
    node = nearer;
  }
  constexpr double kRounding = 1.0 + 1e-6, kLargest = std::numeric_limits<float>::max();
  const double radius = std::min(kLargest, kRounding * std::sqrt(boxOf(node).squaredFarthestDistance(center)));
  withinRadius(center, static_cast<float>(radius), result);
  if (result.size() < k) {  // squares underflow, or overflow
    result.clear(center, std::numeric_limits<float>::infinity());
    result.appendRange(*cloud_, 0, cloud_->size());
  }
  result.keepNearest(k);
}

}  // namespace grasp_affordances
