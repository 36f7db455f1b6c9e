#include "core/sample_draw.h"

#include "core/parallel/random.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grasp_affordances
{
namespace
{

constexpr std::size_t kLaterRounds = 2;
constexpr std::uint64_t kStream = 3;  // the first of the streams of random bits that are used here
constexpr std::uint32_t kNoPlace = std::numeric_limits<std::uint32_t>::max();

/// A number in [-1, 1).
double symmetric(std::uint64_t bits)
{
  return static_cast<double>(bits >> 11U) * 0x1p-52 - 1.0;
}

/// Whether a sample found a shell, or nearly did.
bool promising(Outcome outcome)
{
  return outcome == Outcome::shell || outcome == Outcome::too_short || outcome == Outcome::unobserved_gap ||
         outcome == Outcome::uncovered;
}

}  // namespace

void SampleDraw::start(const PreparedViews& views, const Config& config)
{
  size_ = views.hasSamples() ? static_cast<std::size_t>(config.sampling.samples) : 0;
  first_ = size_;
  if (config.sampling.importance && size_ > 0) {
    first_ =
        std::max<std::size_t>(1, static_cast<std::size_t>(config.sampling.first_share * static_cast<double>(size_)));
  }
  uniform_ = 0;
  round_ends_.clear();
  points_.resize(size_);
  place_of_.resize(size_);
}

std::size_t SampleDraw::drawRound(const PreparedViews& views, const Config& config, const SampleResult* results,
                                  ThreadTeam& team, const Cancellation& cancellation)
{
  const std::size_t begin = drawn();
  if (begin == size_) {
    return begin;
  }
  std::size_t end = first_;
  places_.clear();
  if (begin > 0) {
    findPlaces(views, config, results, cancellation);
    end = std::min(size_, begin + (size_ - first_ + kLaterRounds - 1) / kLaterRounds);
    shareOut(static_cast<std::size_t>((1.0 - config.sampling.uniform_share) * static_cast<double>(end - begin)));
  }
  // Samples near places and others take turns.
  const std::size_t round = end - begin, near = places_.empty() ? 0 : places_.back().draws;
  const auto nearBefore = [&](std::size_t place_in_round) { return place_in_round * near / round; };
  around_.resize(team.size());
  constexpr std::size_t kBatch = 64;
  team.forEach((round + kBatch - 1) / kBatch, [&](std::size_t batch, std::size_t member) {
    for (std::size_t j = batch * kBatch; j < std::min(round, (batch + 1) * kBatch); ++j) {
      const std::size_t before = nearBefore(j);
      points_[begin + j] = nearBefore(j + 1) > before
                               ? drawNear(views, config, begin + j, static_cast<std::uint32_t>(before), around_[member])
                               : views.drawAnywhere(config.sampling, uniform_ + j - before);
    }
  });
  uniform_ += round - near;
  round_ends_.push_back(end);
  return end;
}

/// Gathers the promising ones of the samples so far into places.
void SampleDraw::findPlaces(const PreparedViews& views, const Config& config, const SampleResult* results,
                            const Cancellation& cancellation)
{
  const double reach = config.hand.capture_radius;
  for (std::size_t i = 0; i < drawn(); ++i) {
    cancellation.check();
    place_of_[i] = kNoPlace;
    if (!promising(results[i].outcome)) {
      continue;
    }
    const PreparedViews::MeasuredPoint& sample = points_[i];
    const Eigen::Vector3d point =
        views.T_common_view(sample.view) * views[sample.view].cloud->point(sample.point).cast<double>();
    auto place = std::find_if(places_.begin(), places_.end(), [&](const Place& other) {
      return (other.center - point).squaredNorm() <= reach * reach;
    });
    if (place == places_.end()) {
      place = places_.insert(places_.end(), {point, 0, 0, 0, 0});
    }
    place_of_[i] = static_cast<std::uint32_t>(place - places_.begin());
    ++place->samples;
    place->shells += results[i].outcome == Outcome::shell ? 1 : 0;
  }
  std::uint32_t members = 0;
  for (Place& place : places_) {
    place.first = members;
    members += place.samples;
    place.samples = 0;
  }
  members_.resize(members);
  for (std::size_t i = 0; i < drawn(); ++i) {
    if (place_of_[i] != kNoPlace) {
      Place& place = places_[place_of_[i]];
      members_[place.first + place.samples++] = static_cast<std::uint32_t>(i);
    }
  }
}

/// Shares out at most so many samples among the places.
void SampleDraw::shareOut(std::size_t draws)
{
  constexpr double kMostDraws = 32.0;    // samples for a place in a round
  constexpr std::uint32_t kEnough = 20;  // shells with which a place gets no more samples
  const auto weight = [](const Place& place) { return place.shells < kEnough ? 1.0 / (1.0 + place.shells) : 0.0; };
  double sum = 0.0;
  for (const Place& place : places_) {
    sum += weight(place);
  }
  std::uint32_t total = 0;
  for (Place& place : places_) {
    if (sum > 0.0) {
      total += static_cast<std::uint32_t>(
          std::min(kMostDraws, std::floor(static_cast<double>(draws) * weight(place) / sum)));
    }
    place.draws = total;
  }
}

/// Draws a measured point near one of a place's samples: near in the image, or near in space without an image.
/// @param i  number of the sample
/// @param draw  number of this draw among those near places in its round; it decides on the place
/// @param around  working memory
PreparedViews::MeasuredPoint SampleDraw::drawNear(const PreparedViews& views, const Config& config, std::uint64_t i,
                                                  std::uint32_t draw, Neighborhood& around) const
{
  const std::uint64_t seed = config.sampling.seed;
  const auto place =
      std::find_if(places_.begin(), places_.end(), [draw](const Place& candidate) { return draw < candidate.draws; });
  const std::uint32_t member = randomIndex(randomBits(seed, i, kStream), place->samples);
  const PreparedViews::MeasuredPoint origin = points_[members_[place->first + member]];
  const PreparedCloud& prepared = views[origin.view];
  const Eigen::Vector3f center = prepared.cloud->point(origin.point);
  const double half = std::sqrt(3.0) * config.sampling.spread;  // m, half width of a uniform distribution
  if (!prepared.image) {
    prepared.search->withinRadius(center, static_cast<float>(half), around);
    const std::uint32_t drawn =
        around.index()[randomIndex(randomBits(seed, i, kStream + 1), static_cast<std::uint32_t>(around.size()))];
    return prepared.allows(drawn) ? PreparedViews::MeasuredPoint{origin.view, drawn} : origin;
  }
  const double half_pixels = half / prepared.image->spacing(center.z());
  const auto width = static_cast<std::int64_t>(prepared.cloud->width);
  const auto height = static_cast<std::int64_t>(prepared.cloud->height);
  const std::int64_t column = origin.point % width, row = origin.point / width;
  constexpr std::uint64_t kAttempts = 8;
  for (std::uint64_t attempt = 0; attempt < kAttempts; ++attempt) {
    const std::uint64_t stream = kStream + 1 + 2 * attempt;
    const std::int64_t u = column + std::llround(half_pixels * symmetric(randomBits(seed, i, stream)));
    const std::int64_t v = row + std::llround(half_pixels * symmetric(randomBits(seed, i, stream + 1)));
    if (u < 0 || v < 0 || u >= width || v >= height) {
      continue;
    }
    const auto drawn = static_cast<std::uint32_t>(v * width + u);
    if (prepared.cloud->measured(drawn) && prepared.allows(drawn) &&
        std::abs(prepared.cloud->z[drawn] - center.z()) <= 2.0 * config.hand.capture_radius) {
      return {origin.view, drawn};
    }
  }
  return origin;
}

}  // namespace grasp_affordances
