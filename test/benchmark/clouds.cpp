#include "benchmark/clouds.h"

#include "io/pcd.h"
#include "simulation/scene_library.h"
#include "simulation/sensor.h"
#include "support/recordings.h"

namespace grasp_affordances::test
{

std::vector<NamedCloud> benchmarkClouds()
{
  std::vector<NamedCloud> clouds;
  const std::string recordings = recordingsFolder();
  if (!recordings.empty()) {
    clouds.push_back({"learn33", readPcdCloud(recordings + "/mosd/learn33.pcd")});
  }
  constexpr std::uint64_t kSeed = 101;
  const View view = makeScene("cleaning2", kSeed);
  clouds.push_back({"cleaning2", DepthCamera().capture(view.scene, view.T_scene_camera, kSeed).cloud});
  return clouds;
}

}  // namespace grasp_affordances::test
