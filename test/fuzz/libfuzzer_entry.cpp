#include "fuzz/cpu_time.h"
#include "fuzz/targets.h"

#include <cstdlib>

/// What libFuzzer calls. The target is named by the macro GRASP_AFFORDANCES_FUZZ_TARGET.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace grasp_affordances::fuzz;
  const double start = threadCpuSeconds();
  GRASP_AFFORDANCES_FUZZ_TARGET(data, size);
  require(threadCpuSeconds() - start < longestSeconds(), "an input takes at most a second of processor time");
  return 0;
}
