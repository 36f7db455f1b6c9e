#pragma once

#include "grasp_affordances/config.h"

#include "core/cloud/range_image.h"
#include "core/parallel/thread_team.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// What screenPoints returns, with working memory that is kept from image to image.
class PointScreen
{
public:
  /// @param allowed  one number per pixel, zero where no point is to be kept; null: they may be anywhere
  void update(const RangeImage& image, const HandGeometry& hand, std::size_t enough, std::uint64_t seed,
              ThreadTeam& team, const std::uint8_t* allowed = nullptr);

  /// Keeps no points.
  void clear() { points_.clear(); }

  const std::vector<std::uint32_t>& points() const { return points_; }

private:
  static constexpr std::uint32_t kStride = 2, kCell = 8 * kStride;  // pixels
  static constexpr std::size_t kLattices = kCell / kStride * kCell / kStride;

  std::size_t latticesMissing(std::size_t done, std::size_t enough) const;
  static void screenLattice(const RangeImage& image, const HandGeometry& hand, const std::uint8_t* allowed,
                            std::uint32_t lattice, std::vector<std::uint32_t>& points);

  std::array<std::vector<std::uint32_t>, kLattices> lattices_;  // of each the points that are kept
  std::vector<std::uint32_t> points_;
};

}  // namespace grasp_affordances
