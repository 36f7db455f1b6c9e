#pragma once

#include <ctime>

namespace grasp_affordances::fuzz
{

/// s of processor time that one input may take: independent of what else the machine does.
constexpr double kLongestSeconds = 1.0;

inline double threadCpuSeconds()
{
  std::timespec time;
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace grasp_affordances::fuzz
