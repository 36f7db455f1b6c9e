#pragma once

#include <cstdlib>
#include <ctime>
#include <string>

namespace grasp_affordances::fuzz
{

/// s of processor time that one input may take: 1, or as many as the environment says of tests under a sanitizer.
inline double longestSeconds()
{
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody changes the environment
  static const char* const factor = std::getenv("GRASP_AFFORDANCES_TIME_FACTOR");
  return factor == nullptr ? 1.0 : std::stod(factor);
}

/// Independent of what else the machine does.
inline double threadCpuSeconds()
{
  std::timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace grasp_affordances::fuzz
