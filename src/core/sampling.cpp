#include "grasp_affordances/sampling.h"

#include "grasp_affordances/random.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace grasp_affordances
{
namespace
{

/// Where the image first falls away from a pixel, in pixels from it, along one direction.
class EdgeFinder
{
public:
  EdgeFinder(const RangeImage& image, std::size_t pixel, const HandGeometry& hand)
      : cloud_(image.cloud()),
        u_(static_cast<float>(pixel % cloud_.width)),
        v_(static_cast<float>(pixel / cloud_.width)),
        away_(cloud_.z[pixel] + static_cast<float>(hand.finger_thickness))
  {
    const auto spacing = static_cast<float>(image.spacing(cloud_.z[pixel]));
    constexpr float kShareOfGap = 0.75F;  // the rest may be blurred
    gap_ = kShareOfGap * static_cast<float>(hand.finger_thickness) / spacing;
    span_ = 2.0F * static_cast<float>(hand.capture_radius) / spacing + 2.0F;
    pitch_ = std::max(1.0F, 0.5F * gap_);
  }

  /// The two edges in a direction (unit) and against it are no farther apart than the hand spans.
  bool spans(float du, float dv) const
  {
    const float ahead = distanceToEdge(du, dv, span_);
    return ahead <= span_ && distanceToEdge(-du, -dv, span_ - ahead) <= span_ - ahead;
  }

private:
  static constexpr float kNoEdge = 1e9F;

  float distanceToEdge(float du, float dv, float farthest) const
  {
    float edge = -1.0F;
    for (float s = pitch_; s <= farthest + gap_ + pitch_; s += pitch_) {
      const float u = std::floor(u_ + s * du + 0.5F), v = std::floor(v_ + s * dv + 0.5F);
      if (!(u >= 0.0F && v >= 0.0F && u < static_cast<float>(cloud_.width) && v < static_cast<float>(cloud_.height))) {
        return kNoEdge;
      }
      const float z = cloud_.z[static_cast<std::size_t>(v) * cloud_.width + static_cast<std::size_t>(u)];
      if (z <= away_) {  // false for NaN
        edge = -1.0F;
        continue;
      }
      if (edge < 0.0F) {
        edge = s - pitch_;
      }
      if (s - edge >= gap_) {
        return edge;
      }
    }
    return kNoEdge;
  }

  const Cloud& cloud_;
  float u_, v_;
  float away_;                // m, depth from which on the image has fallen away
  float gap_, span_, pitch_;  // pixels
};

}  // namespace

bool fallsAwayOnBothSides(const RangeImage& image, std::size_t pixel, const HandGeometry& hand)
{
  constexpr float kDiagonal = 0.70710678F;
  constexpr std::array<std::array<float, 2>, 4> kDirections = {
      {{1.0F, 0.0F}, {kDiagonal, kDiagonal}, {0.0F, 1.0F}, {-kDiagonal, kDiagonal}}};
  const EdgeFinder edges(image, pixel, hand);
  return std::any_of(kDirections.begin(), kDirections.end(),
                     [&](const std::array<float, 2>& direction) { return edges.spans(direction[0], direction[1]); });
}

std::vector<std::uint32_t> screenPoints(const RangeImage& image, const HandGeometry& hand, std::size_t enough,
                                        std::uint64_t seed)
{
  constexpr std::uint32_t kStride = 2, kCell = 8 * kStride;  // pixels
  const Cloud& cloud = image.cloud();
  std::array<std::uint32_t, kCell / kStride * kCell / kStride> lattices;
  for (std::uint32_t i = 0; i < lattices.size(); ++i) {
    lattices[i] = i;
    std::swap(lattices[i], lattices[randomIndex(randomBits(seed, i, 2), i + 1)]);
  }

  std::vector<std::uint32_t> points;
  for (const std::uint32_t lattice : lattices) {
    for (std::uint32_t v = lattice / (kCell / kStride) * kStride; v < cloud.height; v += kCell) {
      for (std::uint32_t u = lattice % (kCell / kStride) * kStride; u < cloud.width; u += kCell) {
        const std::uint32_t pixel = v * cloud.width + u;
        if (cloud.measured(pixel) && fallsAwayOnBothSides(image, pixel, hand)) {
          points.push_back(pixel);
        }
      }
    }
    if (points.size() >= enough) {
      break;
    }
  }
  return points;
}

std::uint32_t samplePoint(const std::vector<std::uint32_t>& measured, const std::vector<std::uint32_t>& candidates,
                          const SamplingConfig& config, std::uint64_t i)
{
  const std::uint64_t bits = randomBits(config.seed, i);
  const auto samples = static_cast<std::uint64_t>(config.samples);
  const std::uint64_t count = candidates.size();
  if (count >= samples) {
    const std::uint64_t begin = i * count / samples, end = (i + 1) * count / samples;
    return candidates[begin + randomIndex(bits, static_cast<std::uint32_t>(end - begin))];
  }
  if (i < count) {
    return candidates[i];
  }
  return measured[randomIndex(bits, static_cast<std::uint32_t>(measured.size()))];
}

}  // namespace grasp_affordances
