#include "evaluation/error_causes.h"

#include <algorithm>
#include <cstddef>

namespace grasp_affordances
{
namespace
{

std::string on(const std::string& object)
{
  return object.empty() ? "" : " on " + object;
}

std::string causeOfMiss(const OutcomeCounts& ends)
{
  const auto most = std::max_element(ends.begin(), ends.end());
  if (*most == 0) {
    return "missed: no sample on it";
  }
  const auto outcome = static_cast<Outcome>(most - ends.begin());
  return outcome == Outcome::shell ? "missed: its shells are not right"
                                   : std::string("missed: ") + outcomeName(outcome);
}

}  // namespace

OutcomeCounts endsOn(const Evaluation& evaluation, const Error& error)
{
  OutcomeCounts sum{};
  for (const Run& run : evaluation.frames[error.frame].runs[error.variation]) {
    const auto ends = run.ends.find(error.label);
    if (ends != run.ends.end() && isInError(run, error.kind, error.label)) {
      std::transform(sum.begin(), sum.end(), ends->second.begin(), sum.begin(),
                     [](std::uint32_t a, std::uint32_t b) { return a + b; });
    }
  }
  return sum;
}

std::string causeOf(const Evaluation& evaluation, const Error& error)
{
  const Run& run = evaluation.frames[error.frame].runs[error.variation][error.run];
  switch (error.kind) {
    case Error::miss:
      return causeOfMiss(endsOn(evaluation, error));
    case Error::no_handle:
      return "no handle of its shells";
    case Error::several_handles:
      return "several handles";
    case Error::wrong_handle:
      return "wrong handle" + on(run.handles[error.index].object);
    default:
      return "wrong shell" + on(run.shells[error.index].object);
  }
}

}  // namespace grasp_affordances
