#include "core/views/point_screen.h"

#include "core/parallel/random.h"

#include <algorithm>
#include <cmath>

namespace grasp_affordances
{
namespace
{

/// Looks for the edges around a pixel: for places from which on the image falls away.
class EdgeFinder
{
public:
  EdgeFinder(const RangeImage& image, std::size_t pixel, const HandGeometry& hand)
      : depth_(image.cloud().z.data()),
        row_length_(static_cast<int>(image.cloud().width)),
        width_(static_cast<float>(image.cloud().width)),
        height_(static_cast<float>(image.cloud().height)),
        u_(static_cast<float>(pixel % image.cloud().width)),
        v_(static_cast<float>(pixel / image.cloud().width)),  // NOLINT(bugprone-integer-division): a row
        away_(depth_[pixel] + static_cast<float>(hand.finger_thickness))
  {
    const auto spacing = static_cast<float>(image.spacing(depth_[pixel]));
    constexpr float kShareOfGap = 0.75F;  // the rest may be blurred
    gap_ = kShareOfGap * static_cast<float>(hand.finger_thickness) / spacing;
    span_ = 2.0F * static_cast<float>(hand.capture_radius) / spacing + 2.0F;
    pitch_ = std::max(1.0F, 0.5F * gap_);
  }

  /// Whether there is an edge in a direction (unit) and one in the opposite direction, no farther apart than the hand
  /// can span.
  bool spans(float du, float dv) const
  {
    const float ahead = distanceToEdge(du, dv, span_);
    return ahead <= span_ && distanceToEdge(-du, -dv, span_ - ahead) <= span_ - ahead;
  }

private:
  static constexpr float kNoEdge = 1e9F;

  bool inImage(float u, float v) const { return u >= 0.0F && v >= 0.0F && u < width_ && v < height_; }

  /// Pixels from the pixel to the first edge in a direction. Looks at pixels one pitch apart. Where the gap is wider
  /// than a pitch, two of them in a row must have fallen away. Then, after one that has not, the next but one is looked
  /// at, and the one between only if that has.
  float distanceToEdge(float du, float dv, float farthest) const
  {
    const auto pixelU = [&](float s) { return u_ + s * du + 0.5F; };
    const auto pixelV = [&](float s) { return v_ + s * dv + 0.5F; };
    const auto beyond = [&](float s) {
      return !(depth_[static_cast<int>(pixelV(s)) * row_length_ + static_cast<int>(pixelU(s))] <= away_);
    };
    const float end = farthest + gap_ + pitch_;
    const bool leaves_image = !inImage(pixelU(end), pixelV(end));
    const bool skips = gap_ > 1.5F * pitch_;
    const float skipped = skips ? pitch_ : 0.0F;
    float before = skipped;
    float edge = -1.0F;
    for (float s = before + pitch_; s <= end; s = before + pitch_) {
      if (leaves_image && !inImage(pixelU(s), pixelV(s))) {
        return kNoEdge;
      }
      if (!beyond(s)) {
        edge = -1.0F;
        before = s + skipped;
        continue;
      }
      if (edge < 0.0F) {
        edge = (skips && beyond(before) ? before : s) - pitch_;
      }
      if (s - edge >= gap_) {
        return edge;
      }
      before = s;
    }
    return kNoEdge;
  }

  const float* depth_;
  int row_length_;
  float width_, height_;
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
  ThreadTeam serial(1);
  PointScreen screen;
  screen.update(image, hand, enough, seed, serial);
  return screen.points();
}

void PointScreen::update(const RangeImage& image, const HandGeometry& hand, std::size_t enough, std::uint64_t seed,
                         ThreadTeam& team, const std::uint8_t* allowed)
{
  std::array<std::uint32_t, kLattices> order;
  for (std::uint32_t i = 0; i < kLattices; ++i) {
    order[i] = i;
    std::swap(order[i], order[randomIndex(randomBits(seed, i, 2), i + 1)]);
  }
  const Cloud& cloud = image.cloud();
  const std::size_t cells = ((cloud.width + kCell - 1) / kCell) * std::size_t{(cloud.height + kCell - 1) / kCell};
  points_.clear();
  points_.reserve(kLattices * cells);
  for (auto& points : lattices_) {
    points.reserve(cells);
  }
  std::size_t done = 0;
  for (std::size_t next = team.size(); done < kLattices; next = latticesMissing(done, enough)) {
    next = std::min(next, kLattices - done);
    team.forEach(
        next, [&](std::size_t i, std::size_t) { screenLattice(image, hand, allowed, order[done + i], lattices_[i]); });
    for (std::size_t i = 0; i < next; ++i, ++done) {
      points_.insert(points_.end(), lattices_[i].begin(), lattices_[i].end());
      if (points_.size() >= enough) {
        return;
      }
    }
  }
}

/// How many more lattices will give enough points, if each gives as many as those before did on average; at least one.
std::size_t PointScreen::latticesMissing(std::size_t done, std::size_t enough) const
{
  return points_.empty() ? kLattices : ((enough - points_.size()) * done + points_.size() - 1) / points_.size();
}

void PointScreen::screenLattice(const RangeImage& image, const HandGeometry& hand, const std::uint8_t* allowed,
                                std::uint32_t lattice, std::vector<std::uint32_t>& points)
{
  const Cloud& cloud = image.cloud();
  points.clear();
  for (std::uint32_t v = lattice / (kCell / kStride) * kStride; v < cloud.height; v += kCell) {
    for (std::uint32_t u = lattice % (kCell / kStride) * kStride; u < cloud.width; u += kCell) {
      const std::uint32_t pixel = v * cloud.width + u;
      if (cloud.measured(pixel) && (allowed == nullptr || allowed[pixel] != 0) &&
          fallsAwayOnBothSides(image, pixel, hand)) {
        points.push_back(pixel);
      }
    }
  }
}

}  // namespace grasp_affordances
