#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include "core/fit/curvature.h"
#include "core/fit/quadric.h"
#include "core/neighborhoods/neighborhoods.h"
#include "core/parallel/cancellation.h"
#include "core/parallel/time_budget.h"
#include "core/shell/shell.h"
#include "core/views/prepared_views.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace grasp_affordances
{

/// Where a sample ended.
struct SampleResult
{
  Outcome outcome = Outcome::too_few_points;
  Shell shell;  // set where the outcome is a shell
};

/// What all samples of a localization share.
struct SampleContext
{
  const PreparedViews& views;
  const Config& config;
  const TimeBudget& budget;
  const Cancellation& cancellation;
};

/// Samples that follow one another.
struct SampleSpan
{
  std::uint64_t first;  ///< number of the first one in the localization; its random draws depend on it
  std::size_t count;
  const PreparedViews::MeasuredPoint* points;  ///< where each sample is
  SampleResult* results;                       ///< where each sample ended, out
};

/// The body of Algorithm 1's loop, for a block of samples at a time. Each stage is done for all samples that are left
/// before the next stage begins, since several quadrics are fitted at once. Keeps its working memory: one instance per
/// thread.
class SampleBlock
{
public:
  static constexpr std::size_t kSamples = 64;

  /// Examines at most kSamples samples and writes their results. Once the budget is spent, the samples that are left
  /// end as out of time. Once the localization is cancelled, it returns early, and the results are not valid.
  void examine(const SampleContext& context, const SampleSpan& span);

  StageTimes times;  ///< of the stages of a sample, summed over all samples; callers reset it

private:
  struct Sample
  {
    std::uint64_t number;
    PreparedViews::MeasuredPoint point;
    SphereView* spheres;         // by view
    Neighborhood* neighborhood;  // one of neighborhoods_
    Moments moments;
    std::optional<TaubinFit> fit;
    Eigen::Vector3d axis;  // unit
    double curvature;      // 1/m, NaN where none is measured
    bool concave;
    FittedCylinder cylinder;
    SampleResult* result;

    /// Number of the neighborhood's points that the sample's own view saw. They come first.
    std::size_t ownPoints() const { return spheres[point.view].survey.points; }
  };

  /// Samples that have not ended.
  class Remaining
  {
  public:
    std::size_t size() const { return size_; }
    Sample& operator[](std::size_t i) const { return *samples_[i]; }
    void add(Sample& sample) { samples_[size_++] = &sample; }

    /// Calls stage(sample) for each sample. A sample for which it returns an outcome ends there.
    template <typename Stage>
    void pass(Stage&& stage);

  private:
    std::array<Sample*, kSamples> samples_;
    std::size_t size_ = 0;
  };

  static constexpr std::size_t kFittedAtOnce = TaubinFitter::kCapacity;

  void look(Remaining& samples, const PreparedViews& views, const Config& config, const TimeBudget& budget);
  void findNeighborhoods(Remaining& samples, const PreparedViews& views, const Config& config,
                         const TimeBudget& budget);
  void filterOccluded(Remaining& samples, const PreparedViews& views, const Config& config);
  void sumMoments(Remaining& samples, const Config& config);
  void estimateCurvatureAxes(Remaining& samples, const PreparedViews& views, const Config& config);
  void estimatePrincipalAxes(Remaining& samples, const PreparedViews& views, const Config& config);
  void fitCylinders(Remaining& samples, const PreparedViews& views, const Config& config);
  void fitShells(Remaining& samples, const PreparedViews& views, const Config& config, const TimeBudget& budget);
  std::optional<Outcome> fitShell(Sample& sample, const PreparedViews& views, const Config& config);

  std::array<Sample, kSamples> samples_;
  std::vector<SphereView> spheres_;
  std::array<Neighborhood, kFittedAtOnce> neighborhoods_;
  Neighborhood part_;  // the points of one of several views
  TaubinFitter fitter_;
  CurvatureScratch curvature_scratch_;
  ShellSearch shell_search_;
};

}  // namespace grasp_affordances
