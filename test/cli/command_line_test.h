#pragma once

#include "support/test_with_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include <sys/wait.h>

namespace grasp_affordances::test
{

/// Runs commands in a folder of its own.
class CommandLineTest : public TestWithFolder
{
protected:
  std::string path(const std::string& name) const { return folder_ / name; }

  /// Of a file; empty where there is none.
  std::string content(const std::string& name) const
  {
    std::ostringstream text;
    text << std::ifstream(path(name), std::ios::binary).rdbuf();
    return text.str();
  }

  /// Runs a shell's command, without input; what it writes is in files named stdout and stderr then.
  /// @return exit status; -1, and the test fails, where a signal ended it
  int run(const std::string& command) const
  {
    const std::string line = "cd " + folder_.string() + " && " + command + " > stdout 2> stderr < /dev/null";
    const int status = std::system(line.c_str());  // NOLINT(cert-env33-c,concurrency-mt-unsafe): the test's own command
    EXPECT_TRUE(WIFEXITED(status)) << command << " ended by signal " << WTERMSIG(status);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
};

}  // namespace grasp_affordances::test
