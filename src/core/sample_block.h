#pragma once

#include "grasp_affordances/circle.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/curvature.h"
#include "grasp_affordances/localization.h"
#include "grasp_affordances/neighborhoods.h"
#include "grasp_affordances/quadric.h"
#include "grasp_affordances/shell.h"

#include "core/prepared_cloud.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace grasp_affordances
{

/// Where a sample ended.
struct SampleResult
{
  Outcome outcome = Outcome::too_few_points;
  Shell shell;  // set where the outcome is a shell
};

/// The body of Algorithm 1's loop, for a few samples at a time: each stage is done for all of them that are left before
/// the next, since quadrics are fitted several at once. Keeps its working memory: one instance per thread.
class SampleBlock
{
public:
  static constexpr std::size_t kSamples = 16;

  /// Examines the samples [begin, end), at most kSamples; the result of the first goes to results[0].
  void examine(const PreparedCloud& prepared, const Config& config, std::uint64_t begin, std::uint64_t end,
               SampleResult* results);

  StageTimes times;  ///< summed over the samples since it was last reset

private:
  struct Sample
  {
    std::uint64_t number;
    std::uint32_t point;
    Neighborhood neighborhood;
    Moments moments;
    std::optional<TaubinFit> fit;
    Eigen::Vector3d axis;  // unit
    double curvature;      // 1/m, NaN where none is measured
    bool concave;
    FittedCylinder cylinder;
    SampleResult* result;
  };

  void findNeighborhoods(const PreparedCloud& prepared, const Config& config);
  void filterOccluded(const PreparedCloud& prepared, const Config& config);
  void sumMoments(const Config& config);
  void estimateCurvatureAxes(const PreparedCloud& prepared, const Config& config);
  void estimatePrincipalAxes(const PreparedCloud& prepared, const Config& config);
  void fitCylinders(const PreparedCloud& prepared, const Config& config);
  void fitShells(const PreparedCloud& prepared, const Config& config);
  std::optional<Outcome> fitShell(const PreparedCloud& prepared, const Config& config, Sample& sample);

  /// Calls stage(sample) for the samples that are left; one that is given an outcome ends there.
  template <typename Stage>
  void forEachLeft(Stage&& stage);

  std::array<Sample, kSamples> samples_;
  std::array<Sample*, kSamples> left_;  // those that have not ended
  std::size_t left_count_ = 0;
  TaubinFitter fitter_;
  CurvatureScratch curvature_scratch_;
  ShellSearch shell_search_;
};

}  // namespace grasp_affordances
