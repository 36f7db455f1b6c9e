#include "evaluation/seed_list.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace grasp_affordances
{
namespace
{

std::uint64_t seedOf(const std::string& text)
{
  constexpr std::size_t kMaxDigits = 15;  // less than 2^53, the largest seed of a config
  if (text.empty() || text.size() > kMaxDigits || text.find_first_not_of("0123456789") != std::string::npos) {
    throw std::invalid_argument("'" + text + "' is neither a number nor a range A:B");
  }
  return std::stoull(text);
}

}  // namespace

std::vector<std::uint64_t> seedList(const std::vector<std::string>& words)
{
  constexpr std::uint64_t kMaxSeeds = 100000;
  std::vector<std::uint64_t> seeds;
  for (const std::string& word : words) {
    const std::size_t colon = word.find(':');
    const std::uint64_t first = seedOf(word.substr(0, colon));
    const std::uint64_t last = colon == std::string::npos ? first : seedOf(word.substr(colon + 1));
    if (last < first || last - first >= kMaxSeeds) {
      throw std::invalid_argument("'" + word + "' is no range of 1 to " + std::to_string(kMaxSeeds) + " seeds");
    }
    for (std::uint64_t seed = first; seed <= last; ++seed) {
      seeds.push_back(seed);
    }
  }
  std::vector<std::uint64_t> sorted = seeds;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
    throw std::invalid_argument("a seed is given twice");
  }
  return seeds;
}

}  // namespace grasp_affordances
