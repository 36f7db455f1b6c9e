#pragma once

#include "grasp_affordances/cloud.h"

#include "core/cloud/range_image.h"
#include "core/kernels/surface_ends.h"
#include "core/parallel/thread_team.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// Points of surfaces that go on behind what the sensor sees: of the table beneath a lying can, in the can's own
/// shadow, or of the wall behind a handle.
///
/// A plane's image is linear in inverse depth. Where two stretches of an image row or column lie on one line, and all
/// pixels between them measured something nearer, or nothing, the surface is taken to go on between them. Gaps of at
/// most `max_width` (m) are bridged so. Where the sensor measured something behind that line, there is no surface, and
/// nothing is bridged. Every other row and column is looked at.
///
/// @return an organized cloud of the same size: for each bridged pixel the point of the continued surface, the farther
/// one where row and column differ, and NaN elsewhere
Cloud continueSurfaces(const RangeImage& image, double max_width);

/// What continueSurfaces() returns, with working memory that is kept from image to image.
class HiddenSurfaces
{
public:
  /// Replaces the cloud by the continued surfaces of another image.
  void update(const RangeImage& image, double max_width, ThreadTeam& team);

  /// Takes out the points for which `seen_through(point)` is true. The function is called from many threads.
  template <typename Predicate>
  void remove(Predicate&& seen_through, ThreadTeam& team);

  const Cloud& cloud() const { return cloud_; }

private:
  /// Every other row or column is a scan line; a block of scan lines is as wide as a tile.
  static constexpr std::size_t kStride = 2;
  static constexpr std::size_t kTile = kStride * kScanLines;  // pixels

  /// Working memory of a thread, for a block of scan lines.
  struct Block
  {
    void resize(std::size_t pixels);

    std::vector<float> depth;
    std::vector<double> inverse_depth, sums;
    std::vector<std::uint8_t> last, first;
    std::array<std::vector<int>, kScanLines> left, right;  // by line, the pixels where surfaces end and begin
  };

  void clearTiles(std::size_t tile_row);
  void continueAlong(bool rows, std::size_t tile, const RangeImage& image, double max_width, Block& block);

  Cloud cloud_;
  std::size_t tile_columns_ = 0, tile_rows_ = 0;
  std::vector<std::uint8_t> tiles_;  // row-major: whether a square of pixels has points
  std::vector<Block> blocks_;        // by member of the team
};

template <typename Predicate>
void HiddenSurfaces::remove(Predicate&& seen_through, ThreadTeam& team)
{
  team.forEach(tiles_.size(), [&](std::size_t tile, std::size_t) {
    if (tiles_[tile] == 0) {
      return;
    }
    const std::size_t u_begin = tile % tile_columns_ * kTile, v_begin = tile / tile_columns_ * kTile;
    for (std::size_t v = v_begin; v < std::min<std::size_t>(v_begin + kTile, cloud_.height); ++v) {
      for (std::size_t u = u_begin; u < std::min<std::size_t>(u_begin + kTile, cloud_.width); ++u) {
        const std::size_t pixel = v * cloud_.width + u;
        if (cloud_.measured(pixel) && seen_through(cloud_.point(pixel))) {
          cloud_.x[pixel] = cloud_.y[pixel] = cloud_.z[pixel] = std::nanf("");
        }
      }
    }
  });
}

}  // namespace grasp_affordances
