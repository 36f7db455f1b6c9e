#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include "core/parallel/cancellation.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// Whether two shells are about one stretch of one axis, or about stretches of a bent one that follow each other: their
/// axes come as close as `max_distance` at an angle of at most `max_angle`, or at any angle near an end of each, which
/// is a corner; and their inner radii differ by little. Where a bar has a step, shells about the slimmer part end
/// before it: there, and only there, a gap of `max_gap` is allowed, since one between equal radii means that something
/// blocks the bar.
///
/// Or whether they are about one round thing, an apple, which has no axis of its own: then their middles nearly
/// coincide and neither is much longer than it is wide.
bool shareAxis(const Shell& a, const Shell& b, const HandlesConfig& config);

/// Shells that hang together by shareAxis(), directly or through others. The groups do not depend on the order of the
/// shells. Keeps its memory.
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

  /// Groups the shells; the group of the first shell comes first.
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

  std::vector<std::uint32_t> parents_;  // of a forest whose trees are the groups
  std::vector<float> x_, y_, z_;        // m, the shells' middles
  std::vector<std::uint32_t> members_;
  std::vector<std::uint32_t> begins_{0};
  std::vector<std::uint32_t> groups_;  // of each root
};

}  // namespace grasp_affordances
