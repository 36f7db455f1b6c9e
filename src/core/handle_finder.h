#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/handle.h"
#include "grasp_affordances/localization.h"

#include "core/prepared_views.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// Groups shells that share an axis into handles.
class HandleFinder
{
public:
  /// The handles of the shells of one localization, the best first, without hand poses.
  void find(const PreparedViews& views, const Config& config, const std::vector<Shell>& shells,
            std::vector<GraspHandle>& handles);

private:
  std::vector<std::vector<std::uint32_t>> groups_;
};

}  // namespace grasp_affordances
