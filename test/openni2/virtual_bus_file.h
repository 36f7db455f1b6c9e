#pragma once

#include <gtest/gtest.h>

#include <unistd.h>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

namespace grasp_affordances
{

/// A file that lists the virtual devices of this process, see parseDeviceList().
class VirtualBusFile
{
public:
  VirtualBusFile() : path_(testing::TempDir() + "virtual_devices_" + std::to_string(getpid()) + ".yaml")
  {
    write("[]");
    // NOLINTNEXTLINE(concurrency-mt-unsafe): before there is another thread
    setenv("GRASP_AFFORDANCES_VIRTUAL_DEVICES", path_.c_str(), 1);
  }

  ~VirtualBusFile() { std::remove(path_.c_str()); }

  /// In one piece: the driver never reads half a list.
  void write(const std::string& list) const
  {
    const std::string written = path_ + ".new";
    std::ofstream(written) << list;
    ASSERT_EQ(std::rename(written.c_str(), path_.c_str()), 0);
  }

private:
  const std::string path_;
};

}  // namespace grasp_affordances
