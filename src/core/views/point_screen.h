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

/// Whether a hand could reach around both sides of a pixel's surface. Four directions across the image are tried. In
/// one of them the image must fall away on both sides: from some pixel on, over three quarters of the finger thickness,
/// it shows nothing measured, or something farther from the sensor by at least the finger thickness. The two edges must
/// be no farther apart than the hand can span. The image's border is no such edge.
///
/// This holds all over what a shell can enclose, and hardly anywhere on planes and in inside corners. It does not tell
/// that a surface is enclosed.
bool fallsAwayOnBothSides(const RangeImage& image, std::size_t pixel, const HandGeometry& hand);

/// Measured points that fall away on both sides. The pixels of every other row and column are tried. They are divided
/// into 64 lattices, each of which spreads evenly over the image, and the lattices are tried one after another. After
/// the lattice with which there are `enough` points the rest are left out. The seed decides on the order of the
/// lattices.
/// @return indices of the points in the cloud
std::vector<std::uint32_t> screenPoints(const RangeImage& image, const HandGeometry& hand, std::size_t enough,
                                        std::uint64_t seed);

/// What screenPoints() returns, with working memory that is kept from image to image.
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
