#include "evaluation/evaluation.h"

#include "evaluation/parallel.h"
#include "grasp_affordances/localizer.h"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <optional>

namespace grasp_affordances
{
namespace
{

/// Judges what is found in a frame, and tells what wrong ones are on.
class FrameJudge
{
public:
  FrameJudge(const LabelledCloud& labelled, std::size_t views)
      : labelled_(labelled), judge_(labelled.cloud, labelled.labels)
  {
    for (std::size_t i = 0; i + 1 < views; ++i) {
      const FurtherView& view = labelled.further_views.at(i);
      judge_.addView(view.cloud, view.labels, view.T_first_this);
    }
    if (!labelled.objects.empty()) {
      objects_.emplace(labelled.cloud, labelled.objects);
    }
  }

  JudgedShell operator()(const Shell& shell) const
  {
    const Verdict verdict = judge_(shell);
    return {shell, verdict, objectOf(shell, verdict)};
  }

  JudgedHandle operator()(const GraspHandle& handle) const
  {
    const Verdict verdict = judge_(handle);
    JudgedHandle result{handle, verdict, {}, handle.hand_poses.size(), objectOf(handle, verdict)};
    result.handle.hand_poses = {};
    for (const Affordance& affordance : labelled_.affordances) {
      if (affordance.label == verdict.affordance) {
        result.errors = handleErrors(handle, affordance);
      }
    }
    return result;
  }

private:
  template <class Found>
  std::string objectOf(const Found& found, const Verdict& verdict) const
  {
    const auto object =
        objects_ && verdict.kind == Verdict::wrong ? objects_->commonest(found) : std::optional<std::uint32_t>();
    return object ? labelled_.object_names[*object] : std::string();
  }

  const LabelledCloud& labelled_;
  Judge judge_;
  std::optional<Judge> objects_;  // with objects in place of labels
};

Localization localize(const LabelledCloud& labelled, std::size_t views, Localizer& localizer)
{
  std::vector<PosedCloud> clouds{{&labelled.cloud, Eigen::Isometry3d::Identity()}};
  for (std::size_t i = 0; i + 1 < views; ++i) {
    const FurtherView& view = labelled.further_views.at(i);
    clouds.push_back({&view.cloud, view.T_first_this});
  }
  Localization result;
  localizer.localize(clouds, result);
  return result;
}

/// Label of the point of that index; the points of several views are counted one view after the other.
std::uint32_t labelOf(const LabelledCloud& labelled, std::size_t point)
{
  if (point < labelled.labels.size()) {
    return labelled.labels[point];
  }
  point -= labelled.labels.size();
  std::size_t view = 0;
  for (; point >= labelled.further_views.at(view).labels.size(); ++view) {
    point -= labelled.further_views[view].labels.size();
  }
  return labelled.further_views[view].labels[point];
}

std::map<std::uint32_t, OutcomeCounts> endsOnAffordances(const LabelledCloud& labelled,
                                                         const std::vector<SampleEnd>& samples)
{
  std::map<std::uint32_t, OutcomeCounts> ends;
  for (const SampleEnd& sample : samples) {
    const std::uint32_t label = labelOf(labelled, sample.point_index);
    if (label != kNotGraspable && label != kDoubtful) {
      ++ends[label][static_cast<std::size_t>(sample.outcome)];
    }
  }
  return ends;
}

Run evaluateRun(const LabelledCloud& labelled, const FrameJudge& judge, const Variation& variation, std::size_t run)
{
  Config config = variation.config;
  config.hand.capture_radius = labelled.capture_radius;
  config.sampling.seed = run + 1;
  config.threads = 1;
  Localizer localizer(config);
  const Localization localization = localize(labelled, variation.views, localizer);
  Run result;
  result.sampled = localization.sampled;
  result.ends = endsOnAffordances(labelled, localizer.sampleEnds());
  for (const Shell& shell : localization.shells) {
    result.shells.push_back(judge(shell));
  }
  for (const GraspHandle& handle : localization.handles) {
    result.handles.push_back(judge(handle));
  }
  return result;
}

std::uint32_t measuredPoints(const Cloud& cloud)
{
  std::uint32_t points = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    points += cloud.measured(i) ? 1 : 0;
  }
  return points;
}

/// Sets what the views show.
void countPoints(const LabelledCloud& labelled, FrameResult& result)
{
  result.points = measuredPoints(labelled.cloud);
  for (const FurtherView& view : labelled.further_views) {
    result.further_views.push_back({measuredPoints(view.cloud), {}});
  }
  for (const Affordance& affordance : labelled.affordances) {
    std::vector<std::size_t> elsewhere;
    for (const FurtherView& view : labelled.further_views) {
      elsewhere.push_back(
          static_cast<std::size_t>(std::count(view.labels.begin(), view.labels.end(), affordance.label)));
    }
    if (std::accumulate(elsewhere.begin(), elsewhere.end(), affordance.visible_points) > 0) {
      result.affordances.push_back(affordance);
      for (std::size_t i = 0; i < elsewhere.size(); ++i) {
        result.further_views[i].visible_points.push_back(elsewhere[i]);
      }
    }
  }
}

FrameResult evaluateFrame(const EvaluationFrame& frame, const std::vector<Variation>& variations, std::size_t runs)
{
  const LabelledCloud labelled = frame.load();
  FrameResult result;
  result.group = frame.group;
  result.scene = frame.scene;
  result.seed = frame.seed;
  result.capture_radius = labelled.capture_radius;
  countPoints(labelled, result);
  for (const Variation& variation : variations) {
    const FrameJudge judge(labelled, variation.views);
    result.runs.emplace_back();
    for (std::size_t run = 0; run < runs; ++run) {
      result.runs.back().push_back(evaluateRun(labelled, judge, variation, run));
    }
  }
  return result;
}

}  // namespace

bool finds(const Run& run, std::uint32_t label)
{
  return std::any_of(run.shells.begin(), run.shells.end(),
                     [label](const JudgedShell& judged) { return judged.verdict.affordance == label; });
}

std::size_t handlesOn(const Run& run, std::uint32_t label)
{
  return static_cast<std::size_t>(
      std::count_if(run.handles.begin(), run.handles.end(),
                    [label](const JudgedHandle& judged) { return judged.verdict.affordance == label; }));
}

std::size_t pointsIn(const FrameResult& frame, std::size_t views)
{
  std::size_t points = frame.points;
  for (std::size_t i = 0; i + 1 < views; ++i) {
    points += frame.further_views.at(i).points;
  }
  return points;
}

std::size_t visiblePoints(const FrameResult& frame, std::size_t affordance, std::size_t views)
{
  std::size_t points = frame.affordances[affordance].visible_points;
  for (std::size_t i = 0; i + 1 < views; ++i) {
    points += frame.further_views.at(i).visible_points[affordance];
  }
  return points;
}

std::size_t visibleElsewhere(const FrameResult& frame, std::size_t affordance)
{
  std::size_t most = 0;
  for (const ViewCounts& view : frame.further_views) {
    most = std::max(most, view.visible_points[affordance]);
  }
  return most;
}

std::vector<FrameResult> evaluate(const std::vector<EvaluationFrame>& frames, const std::vector<Variation>& variations,
                                  std::size_t runs, std::size_t threads, const std::function<void()>& done)
{
  std::vector<FrameResult> results(frames.size());
  std::mutex mutex;
  forEachInParallel(frames.size(), threads, [&](std::size_t i) {
    results[i] = evaluateFrame(frames[i], variations, runs);
    const std::lock_guard<std::mutex> lock(mutex);
    done();
  });
  return results;
}

}  // namespace grasp_affordances
