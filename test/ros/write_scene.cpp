// write_scene SCENE SEED TURN NOISE_SEED FILE: what the tool simulate writes as --out, without the labels of
// affordances, for the tests of ROS: they also run where CLI11 is missing, and the tools with it.

#include "simulation/camera_orbit.h"
#include "simulation/placement.h"
#include "simulation/scene_library.h"
#include "simulation/sensor.h"

#include <pcl/io/pcd_io.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <iostream>
#include <string>

namespace ga = grasp_affordances;

namespace
{

void writeScene(const std::string& scene, std::uint64_t seed, double turn_deg, std::uint64_t noise_seed,
                const std::string& file)
{
  const ga::View view = ga::viewFromAside(ga::makeScene(scene, seed), ga::kDegree * turn_deg);
  const ga::Frame frame = ga::DepthCamera().capture(view.scene, view.T_scene_camera, seed + noise_seed);
  pcl::PointCloud<pcl::PointXYZL> cloud(frame.cloud.width, frame.cloud.height);
  for (std::size_t i = 0; i < frame.cloud.size(); ++i)
    cloud[i].getVector3fMap() = frame.cloud.point(i);
  cloud.is_dense = false;
  cloud.sensor_origin_.head<3>() = view.T_scene_camera.translation().cast<float>();
  cloud.sensor_orientation_ = Eigen::Quaterniond(view.T_scene_camera.linear()).cast<float>();
  pcl::PCDWriter().writeBinaryCompressed(file, cloud);
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc != 6) {
    std::cerr << "usage: write_scene SCENE SEED TURN NOISE_SEED FILE\n";
    return 2;
  }
  try {
    writeScene(argv[1], std::stoull(argv[2]), std::stod(argv[3]), std::stoull(argv[4]), argv[5]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "write_scene: " << error.what() << '\n';
    return 1;
  }
}
