#include "evaluation/errors.h"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <utility>

namespace grasp_affordances
{
namespace
{

/// Places of one frame and variation with something wrong.
class WrongPlaces
{
public:
  WrongPlaces(Error::Kind kind, std::size_t frame, std::size_t variation, double distance)
      : first_{kind, frame, variation, 0, 1, 0, 0}, distance_(distance)
  {
  }

  void add(std::size_t run, std::size_t index, const Eigen::Vector3d& centroid)
  {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if ((centroids_[i] - centroid).norm() < distance_) {
        ++places_[i].count;
        return;
      }
    }
    places_.push_back(first_);
    places_.back().run = run;
    places_.back().index = index;
    centroids_.push_back(centroid);
  }

  const std::vector<Error>& places() const { return places_; }

private:
  Error first_;
  double distance_;
  std::vector<Error> places_;
  std::vector<Eigen::Vector3d> centroids_;
};

std::vector<Error> wrongShells(const Evaluation& evaluation, std::size_t frame, std::size_t variation)
{
  const auto& runs = evaluation.frames[frame].runs[variation];
  WrongPlaces wrong(Error::wrong_shell, frame, variation, evaluation.frames[frame].capture_radius);
  for (std::size_t run = 0; run < runs.size(); ++run) {
    for (std::size_t i = 0; i < runs[run].shells.size(); ++i) {
      if (runs[run].shells[i].verdict.kind == Verdict::wrong) {
        wrong.add(run, i, runs[run].shells[i].shell.centroid);
      }
    }
  }
  return wrong.places();
}

std::vector<Error> wrongHandles(const Evaluation& evaluation, std::size_t frame, std::size_t variation)
{
  const auto& runs = evaluation.frames[frame].runs[variation];
  WrongPlaces wrong(Error::wrong_handle, frame, variation, evaluation.frames[frame].capture_radius);
  for (std::size_t run = 0; run < runs.size(); ++run) {
    for (std::size_t i = 0; i < runs[run].handles.size(); ++i) {
      if (runs[run].handles[i].verdict.kind == Verdict::wrong) {
        wrong.add(run, i, runs[run].handles[i].handle.centroid);
      }
    }
  }
  return wrong.places();
}

/// Visible affordances that are in error in some run.
std::vector<Error> affordancesInError(Error::Kind kind, const Evaluation& evaluation, std::size_t frame,
                                      std::size_t variation)
{
  const FrameResult& result = evaluation.frames[frame];
  std::vector<Error> errors;
  for (std::size_t i = 0; i < result.affordances.size(); ++i) {
    if (visiblePoints(result, i, evaluation.variations[variation].views) == 0) {
      continue;
    }
    Error error{kind, frame, variation, 0, 0, 0, result.affordances[i].label};
    for (std::size_t run = 0; run < result.runs[variation].size(); ++run) {
      if (isInError(result.runs[variation][run], kind, error.label)) {
        error.run = error.count == 0 ? run : error.run;
        ++error.count;
      }
    }
    if (error.count > 0) {
      errors.push_back(error);
    }
  }
  return errors;
}

std::vector<Error> errorsOf(const Evaluation& evaluation, std::size_t frame, std::size_t variation)
{
  std::vector<Error> errors = wrongShells(evaluation, frame, variation);
  const auto append = [&](const std::vector<Error>& more) { errors.insert(errors.end(), more.begin(), more.end()); };
  append(wrongHandles(evaluation, frame, variation));
  for (const Error::Kind kind : {Error::miss, Error::no_handle, Error::several_handles}) {
    append(affordancesInError(kind, evaluation, frame, variation));
  }
  return errors;
}

bool isWrong(Error::Kind kind)
{
  return kind == Error::wrong_shell || kind == Error::wrong_handle;
}

}  // namespace

bool isInError(const Run& run, Error::Kind kind, std::uint32_t label)
{
  switch (kind) {
    case Error::miss:
      return !finds(run, label);
    case Error::no_handle:
      return finds(run, label) && handlesOn(run, label) == 0;
    case Error::several_handles:
      return handlesOn(run, label) > 1;
    default:
      return false;
  }
}

std::size_t affordanceIndex(const FrameResult& frame, const Error& error)
{
  const auto found = std::find_if(frame.affordances.begin(), frame.affordances.end(),
                                  [&](const Affordance& affordance) { return affordance.label == error.label; });
  return static_cast<std::size_t>(found - frame.affordances.begin());
}

std::vector<Error> worstErrors(const Evaluation& evaluation, std::size_t limit)
{
  // Per scene, variation and kind, the worst first.
  std::map<std::tuple<std::string, std::size_t, Error::Kind>, std::vector<Error>> errors;
  for (std::size_t frame = 0; frame < evaluation.frames.size(); ++frame) {
    for (std::size_t variation = 0; variation < evaluation.variations.size(); ++variation) {
      for (const Error& error : errorsOf(evaluation, frame, variation)) {
        errors[{evaluation.frames[frame].scene, variation, error.kind}].push_back(error);
      }
    }
  }
  const auto weight = [&](const Error& error) {
    const FrameResult& frame = evaluation.frames[error.frame];
    return isWrong(error.kind)
               ? error.count
               : visiblePoints(frame, affordanceIndex(frame, error), evaluation.variations[error.variation].views);
  };
  std::vector<Error> worst;
  for (auto& [key, candidates] : errors) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](const Error& a, const Error& b) { return weight(a) > weight(b); });
    candidates.resize(std::min(limit, candidates.size()));
    worst.insert(worst.end(), candidates.begin(), candidates.end());
  }
  return worst;
}

}  // namespace grasp_affordances
