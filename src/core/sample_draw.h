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

/// Draws the points of a localization's samples, round after round.
///
/// The first round looks everywhere. With importance sampling the later rounds are a mixture. Some of their samples are
/// drawn as in the first round. The others are drawn near promising samples of the rounds before: those that ended as a
/// shell, or nearly so, with a clear gap over too short a length, or with one that was not seen well enough. Promising
/// samples that are near to one another make up a place. The fewer shells a place has, the more samples are drawn
/// there: a part that was hit once is looked at closely, and one that has many shells is left alone. Samples that the
/// places do not need are drawn as in the first round.
///
/// Keeps its memory from localization to localization.
class SampleDraw
{
public:
  /// Starts over, for other clouds.
  void start(const PreparedViews& views, const Config& config);

  /// Number of samples of all rounds.
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
    Eigen::Vector3d center;  // m, of its first sample
    std::uint32_t samples;   // number of its samples
    std::uint32_t shells;    // number of its samples that ended as a shell
    std::uint32_t first;     // of its samples in members_
    std::uint32_t draws;     // number of samples of the next round at this place and those before it
  };

  void findPlaces(const PreparedViews& views, const Config& config, const SampleResult* results,
                  const Cancellation& cancellation);
  void shareOut(std::size_t draws);
  PreparedViews::MeasuredPoint drawNear(const PreparedViews& views, const Config& config, std::uint64_t i,
                                        std::uint32_t draw, Neighborhood& around) const;

  std::size_t drawn() const { return round_ends_.empty() ? 0 : round_ends_.back(); }

  std::size_t size_ = 0;
  std::size_t first_ = 0;    // number of samples of the first round
  std::size_t uniform_ = 0;  // number of samples so far that were drawn as in the first round
  std::vector<std::size_t> round_ends_;
  std::vector<PreparedViews::MeasuredPoint> points_;
  std::vector<Place> places_;
  std::vector<std::uint32_t> place_of_;  // by sample: its place, or kNoPlace
  std::vector<std::uint32_t> members_;   // samples, place after place
  std::vector<Neighborhood> around_;     // one per thread
};

}  // namespace grasp_affordances
