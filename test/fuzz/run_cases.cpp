#include "fuzz/cpu_time.h"
#include "fuzz/crowds.h"
#include "fuzz/targets.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

namespace grasp_affordances::fuzz
{
namespace
{

std::vector<std::filesystem::path> filesIn(const std::filesystem::path& folder)
{
  std::vector<std::filesystem::path> files;
  if (std::filesystem::is_directory(folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

void run(const Target& target, const std::filesystem::path& file)
{
  std::printf("%s %s", target.name, file.c_str());
  std::fflush(stdout);
  std::ifstream stream(file, std::ios::binary);
  const std::vector<char> bytes(std::istreambuf_iterator<char>(stream), {});
  const double start = threadCpuSeconds();
  target.run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  const double seconds = threadCpuSeconds() - start;
  std::printf(" %.3f s\n", seconds);
  require(seconds < longestSeconds(), "an input takes at most a second of processor time");
}

/// fuzz_cases FOLDER ...: in each, a folder of inputs for each target. And crowds.
int runCases(int folders, char** folder)
{
  for (const Target& target : kTargets) {
    std::size_t files = 0;
    for (int i = 0; i < folders; ++i) {
      for (const std::filesystem::path& file : filesIn(std::filesystem::path(folder[i]) / target.name)) {
        run(target, file);
        ++files;
      }
    }
    require(files > 0, "every target has inputs");
  }
  runCrowds();
  return 0;
}

}  // namespace
}  // namespace grasp_affordances::fuzz

int main(int argc, char** argv)
{
  return grasp_affordances::fuzz::runCases(argc - 1, argv + 1);
}
