#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include <unistd.h>

namespace grasp_affordances::test
{

/// Has a folder to write to, empty when the test begins and gone when it has ended. Tests in several processes do not
/// share it.
class TestWithFolder : public testing::Test
{
protected:
  TestWithFolder() { std::filesystem::create_directories(folder_); }

  void TearDown() override { std::filesystem::remove_all(folder_); }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("grasp_affordances_test_" + std::to_string(::getpid()));
};

}  // namespace grasp_affordances::test
