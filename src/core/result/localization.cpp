#include "grasp_affordances/localization.h"

namespace grasp_affordances
{

Eigen::Vector3d withLargestComponentPositive(const Eigen::Vector3d& axis)
{
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0.0 ? Eigen::Vector3d(-axis) : axis;
}

Shell transformed(Shell shell, const Eigen::Isometry3d& T)
{
  shell.centroid = T * shell.centroid;
  shell.axis = withLargestComponentPositive(T.linear() * shell.axis);
  shell.normal = T.linear() * shell.normal;
  return shell;
}

const char* outcomeName(Outcome outcome)
{
  static constexpr std::array<const char*, kOutcomes> kNames{
      "too_few_points", "degenerate",     "occluded",  "low_curvature", "concave", "no_shell",
      "too_short",      "unobserved_gap", "uncovered", "out_of_time",   "shells"};
  return kNames[static_cast<std::size_t>(outcome)];  // cppcheck-suppress CastIntegerToAddressAtReturn; not an integer
}

const char* describe(NothingSampled reason)
{
  static constexpr std::array<const char*, kNothingSampledReasons> kDescriptions{
      "there was no cloud to draw samples from", "the cloud is empty", "all points are NaN, zero or infinite",
      "all measured points coincide", "no measured point lies within the workspace"};
  // cppcheck-suppress CastIntegerToAddressAtReturn; not an integer
  return kDescriptions[static_cast<std::size_t>(reason)];
}

}  // namespace grasp_affordances
