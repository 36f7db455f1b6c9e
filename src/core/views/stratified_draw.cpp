#include "core/views/stratified_draw.h"

#include "core/parallel/random.h"

namespace grasp_affordances
{

std::uint32_t drawStratified(const std::vector<std::uint32_t>& measured, const std::vector<std::uint32_t>& candidates,
                             const SamplingConfig& config, std::uint64_t i)
{
  const std::uint64_t bits = randomBits(config.seed, i);
  const auto samples = static_cast<std::uint64_t>(config.samples);
  const std::uint64_t count = candidates.size();
  if (count >= samples) {
    const std::uint64_t begin = i * count / samples, end = (i + 1) * count / samples;
    return candidates[begin + randomIndex(bits, static_cast<std::uint32_t>(end - begin))];
  }
  if (i < count) {
    return candidates[i];
  }
  return measured[randomIndex(bits, static_cast<std::uint32_t>(measured.size()))];
}

}  // namespace grasp_affordances
