#pragma once

#include "grasp_affordances/config.h"

#include "core/neighborhoods/neighborhoods.h"
#include "core/parallel/cancellation.h"
#include "core/parallel/thread_team.h"
#include "core/sample_block.h"
#include "core/views/prepared_views.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// Which points the samples of a localization are drawn at, round after round.
///
/// The first round looks everywhere. With importance sampling the samples of later rounds are a mixture: some go on as
/// those of the first; the rest are drawn near samples that ended as a shell, or nearly so: with a clear gap over too
/// short a length, or one that was not seen well enough. These samples are gathered into places, and a place gets the
/// more the fewer shells it has: what was hit once is looked at closely, what is known well is left alone.
/// What the places do not need is drawn like the first ones, too.
///
/// Keeps its memory.
class SampleDraw
{
public:
  /// Starts over, for other clouds.
  void start(const PreparedViews& views, const Config& config);

  /// Samples of all rounds.
  std::size_t size() const { return size_; }

  /// Draws the next round; nothing, where all rounds are over.
  /// @param results  of the samples that were drawn before, in their order
  /// @return the number of samples that are drawn now
  /// @throw Cancelled
  std::size_t drawRound(const PreparedViews& views, const Config& config, const SampleResult* results, ThreadTeam& team,
                        const Cancellation& cancellation = Cancellation());

  /// The points, in the order of the samples: size() of them, of which those drawn so far are valid.
  const PreparedViews::MeasuredPoint* points() const { return points_.data(); }

  /// By round, the number of samples that were drawn when it ended.
  const std::vector<std::size_t>& roundEnds() const { return round_ends_; }

private:
  /// Promising samples that are near to one another.
  struct Place
  {
    Eigen::Vector3d center;  // m, of the sample that it began with
    std::uint32_t samples;   // number of them
    std::uint32_t shells;    // of these
    std::uint32_t first;     // in members_
    std::uint32_t draws;     // that go to this place and those before it
  };

  void findPlaces(const PreparedViews& views, const Config& config, const SampleResult* results,
                  const Cancellation& cancellation);
  void shareOut(std::size_t draws);
  PreparedViews::MeasuredPoint drawNear(const PreparedViews& views, const Config& config, std::uint64_t i,
                                        std::uint32_t draw, Neighborhood& around) const;

  std::size_t drawn() const { return round_ends_.empty() ? 0 : round_ends_.back(); }

  std::size_t size_ = 0;
  std::size_t first_ = 0;    // samples of the first round
  std::size_t uniform_ = 0;  // of the samples drawn so far, those that were drawn like the first ones
  std::vector<std::size_t> round_ends_;
  std::vector<PreparedViews::MeasuredPoint> points_;
  std::vector<Place> places_;
  std::vector<std::uint32_t> place_of_, members_;  // of each sample, where it has one; samples by place
  std::vector<Neighborhood> around_;               // one per thread
};

}  // namespace grasp_affordances
