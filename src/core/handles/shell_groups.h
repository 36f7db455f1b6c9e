#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include "core/parallel/cancellation.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// Whether two shells share an axis: they are about the same part of one axis, or about parts of a bent axis that
/// follow each other. They do in any of three cases, all of which require inner radii that differ by
/// `max_radius_difference` or less:
/// - The axes come as close as `max_distance`, at an angle of at most `max_angle`. Near an end of both, any angle will
///   do: the axis has a corner there.
/// - The radius of a bar has a step. Shells about the slimmer part end before the step, so that a gap of `max_gap` is
///   allowed between ends of shells with different radii. Between equal radii a gap means that something blocks the
///   bar.
/// - Both are about one round thing, such as an apple, which has no axis of its own: their middles nearly coincide, and
///   neither is much longer than it is wide.
bool shareAxis(const Shell& a, const Shell& b, const HandlesConfig& config);

/// Groups of shells that share an axis (see shareAxis), directly or through other shells. The order of the shells does
/// not matter. Keeps its memory.
class ShellGroups
{
public:
  /// Indices of one group's shells, ascending.
  class Group
  {
  public:
    Group(const std::uint32_t* begin, const std::uint32_t* end) : begin_(begin), end_(end) {}
    const std::uint32_t* begin() const { return begin_; }
    const std::uint32_t* end() const { return end_; }
    std::size_t size() const { return static_cast<std::size_t>(end_ - begin_); }
    std::uint32_t operator[](std::size_t i) const { return begin_[i]; }

  private:
    const std::uint32_t* begin_;
    const std::uint32_t* end_;
  };

  /// Groups the shells. The groups are in the order of their first shells.
  /// @throw Cancelled
  void update(const std::vector<Shell>& shells, const HandlesConfig& config,
              const Cancellation& cancellation = Cancellation());

  std::size_t size() const { return begins_.size() - 1; }
  Group operator[](std::size_t group) const
  {
    return {members_.data() + begins_[group], members_.data() + begins_[group + 1]};
  }

private:
  std::uint32_t rootOf(std::uint32_t shell);

  std::vector<std::uint32_t> parents_;  // in a forest: each tree is a group
  std::vector<float> x_, y_, z_;        // m, the shells' middles
  std::vector<std::uint32_t> members_;
  std::vector<std::uint32_t> begins_{0};
  std::vector<std::uint32_t> groups_;  // number of each root's group
};

}  // namespace grasp_affordances
