#pragma once

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace grasp_affordances::test
{

inline bool isFolder(const std::string& path)
{
  struct stat status
  {
  };
  return stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode);
}

/// Folder of the recorded clouds, or an empty string where they are absent. @throw std::runtime_error where the
/// environment promises a folder that does not exist.
inline std::string recordingsFolder()
{
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody changes the environment
  if (const char* folder = std::getenv("GRASP_AFFORDANCES_DATA")) {
    if (!isFolder(folder)) {
      throw std::runtime_error(std::string("GRASP_AFFORDANCES_DATA names no folder: ") + folder);
    }
    return folder;
  }
  const std::string folder = GRASP_AFFORDANCES_SOURCE_DIR "/../shared/data";
  return isFolder(folder) ? folder : "";
}

}  // namespace grasp_affordances::test

/// Skips the test where the recordings are absent; otherwise declares `folder`.
#define REQUIRE_RECORDINGS(folder)                                         \
  const std::string folder = grasp_affordances::test::recordingsFolder();  \
  if ((folder).empty()) {                                                  \
    GTEST_SKIP() << "SKIPPED: no recordings (set GRASP_AFFORDANCES_DATA)"; \
  }
