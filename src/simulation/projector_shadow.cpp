#include "simulation/projector_shadow.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace grasp_affordances
{
namespace
{

/// A set of the projector's columns. Columns are added and queried roughly from right to left.
class CoveredColumns
{
public:
  bool contains(double column) const
  {
    const auto next = std::find_if(intervals_.rbegin(), intervals_.rend(),
                                   [&](const Interval& interval) { return interval.high > column; });
    return next != intervals_.rend() && next->low <= column;
  }

  void add(double low, double high)
  {
    auto end = intervals_.end();
    while (end != intervals_.begin() && std::prev(end)->high < low)
      --end;
    auto begin = end;
    while (begin != intervals_.begin() && std::prev(begin)->low <= high) {
      --begin;
      low = std::min(low, begin->low);
      high = std::max(high, begin->high);
    }
    if (begin == end) {
      intervals_.insert(end, {low, high});
    } else {
      *begin = {low, high};
      intervals_.erase(begin + 1, end);
    }
  }

private:
  struct Interval
  {
    double low, high;
  };
  std::vector<Interval> intervals_;  ///< disjoint, from the right to the left
};

}  // namespace

void findProjectorShadow(const float* disparity, const float* occluder, int width, std::uint8_t* shadowed)
{
  const auto continuous = [&](int u) {  // with the pixel to the right
    return occluder[u] > 0.0F && occluder[u + 1] > 0.0F && std::abs(occluder[u + 1] - occluder[u]) < 1.0F;
  };

  CoveredColumns covered;
  for (int u = width - 1; u >= 0; --u) {
    shadowed[u] = disparity[u] > 0.0F && covered.contains(u - double{disparity[u]}) ? 1 : 0;
    if (!(occluder[u] > 0.0F))
      continue;
    const double column = u - double{occluder[u]};
    covered.add(u > 0 && continuous(u - 1) ? column : column - 0.5,
                u + 1 < width && continuous(u) ? u + 1.0 - occluder[u + 1] : column + 0.5);
  }
}

}  // namespace grasp_affordances
