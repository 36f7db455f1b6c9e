#include "evaluation/handle_score.h"

#include "evaluation/units.h"

#include <cmath>

namespace grasp_affordances
{
namespace
{

std::size_t count(const Unit& unit, Verdict::Kind kind)
{
  std::size_t handles = 0;
  for (const FrameRun& member : unit) {
    for (const JudgedHandle& judged : member.run.handles) {
      handles += judged.verdict.kind == kind ? 1 : 0;
    }
  }
  return handles;
}

void add(const FrameRun& member, const VisibilityClass& visibility, HandlesPerAffordance& counts)
{
  const auto& [frame, run] = member;
  for (std::size_t i = 0; i < frame.affordances.size(); ++i) {
    if (visibility.holds(frame.affordances[i], visibleElsewhere(frame, i))) {
      const std::size_t handles = handlesOn(run, frame.affordances[i].label);
      ++(handles == 0 ? counts.none : handles == 1 ? counts.one : counts.several);
    }
  }
}

HandlesPerAffordance handlesPerAffordance(const VisibilityClass& visibility, const std::vector<Unit>& units)
{
  HandlesPerAffordance sum;
  std::vector<Ratio> exactly_one;
  for (const Unit& unit : units) {
    HandlesPerAffordance counts;
    for (const FrameRun& member : unit) {
      add(member, visibility, counts);
    }
    exactly_one.push_back(counts.exactlyOne());
    sum.none += counts.none;
    sum.one += counts.one;
    sum.several += counts.several;
  }
  sum.interval = pooledInterval(exactly_one);
  return sum;
}

/// The known ones among right handles.
std::vector<double> errorsOf(const std::vector<Unit>& units, double HandleErrors::*error)
{
  std::vector<double> errors;
  for (const Unit& unit : units) {
    for (const FrameRun& member : unit) {
      for (const JudgedHandle& judged : member.run.handles) {
        if (judged.verdict.kind == Verdict::right && std::isfinite(judged.errors.*error)) {
          errors.push_back(judged.errors.*error);
        }
      }
    }
  }
  return errors;
}

Spread spread(std::vector<double> errors)
{
  for (double& error : errors) {
    error = std::abs(error);
  }
  return {errors.size(), quantile(errors, 0.5), quantile(errors, 0.9)};
}

}  // namespace

HandleScore scoreHandles(const std::vector<const FrameResult*>& frames, std::size_t variation)
{
  const std::vector<Unit> units = makeUnits(frames, variation);
  HandleScore result;
  std::vector<Ratio> precisions;
  for (const Unit& unit : units) {
    const std::size_t right = count(unit, Verdict::right);
    precisions.push_back({right, right + count(unit, Verdict::wrong)});
    result.not_counted += count(unit, Verdict::not_counted);
  }
  result.precision = pooled(precisions);
  result.interval = pooledInterval(precisions);
  for (std::size_t i = 0; i < kVisibilityClasses.size(); ++i) {
    result.affordances[i] = handlesPerAffordance(kVisibilityClasses[i], units);
  }
  result.center = spread(errorsOf(units, &HandleErrors::center));
  result.axis = spread(errorsOf(units, &HandleErrors::axis));
  const std::vector<double> radius_errors = errorsOf(units, &HandleErrors::radius);
  result.radius = spread(radius_errors);
  result.radius_bias = quantile(radius_errors, 0.5);
  return result;
}

}  // namespace grasp_affordances
