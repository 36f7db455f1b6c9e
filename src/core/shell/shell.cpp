#include "core/shell/shell.h"

#include "core/shell/directed_search.h"
#include "core/shell/evidence.h"
#include "core/shell/view_slices.h"

#include <optional>

namespace grasp_affordances
{

PointThresholds pointThresholds(const ShellConfig& config, double spacing)
{
  PointThresholds thresholds{static_cast<double>(config.gap_points_to_block),
                             static_cast<double>(config.min_points_inside)};
  if (config.scale_with_density && spacing > 0.0) {
    const double ratio = config.reference_spacing / spacing;
    thresholds.gap_points_to_block = evidenceThreshold(thresholds.gap_points_to_block * ratio * ratio);
    thresholds.min_points_inside = evidenceThreshold(thresholds.min_points_inside * ratio * ratio);
  }
  return thresholds;
}

struct ShellSearch::Memory
{
  ViewSlices views;
  std::vector<SliceCounts> counts;  // of each slice, in the shell that was looked at last
};

ShellSearch::ShellSearch() : memory_(std::make_unique<Memory>()) {}
ShellSearch::~ShellSearch() = default;
ShellSearch::ShellSearch(ShellSearch&&) noexcept = default;
ShellSearch& ShellSearch::operator=(ShellSearch&&) noexcept = default;

ShellSearchResult ShellSearch::search(const ShellSurroundings& surroundings, const FittedCylinder& cylinder,
                                      const HandGeometry& hand, const ShellConfig& config)
{
  const auto searchAbout = [&](const FittedCylinder& start, DirectedSearch& search) {
    const ShellSearchResult found = search.about(start);
    if (!config.recenter || found.status != ShellSearchResult::found) {
      return found;
    }
    const auto refitted = search.refit();
    return refitted ? search.about(*refitted) : found;
  };
  DirectedSearch search(surroundings, hand, config, memory_->views, memory_->counts);
  const ShellSearchResult found = searchAbout(cylinder, search);
  if (!config.straighten || surroundings.others == nullptr || surroundings.others->empty() ||
      found.status == ShellSearchResult::found) {
    return found;
  }
  const auto straight = search.straightened();
  if (!straight) {
    return found;
  }
  DirectedSearch again(surroundings, hand, config, memory_->views, memory_->counts);
  return searchAbout(*straight, again);
}

}  // namespace grasp_affordances
