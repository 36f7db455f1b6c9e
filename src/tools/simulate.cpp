// Renders a scene as the virtual Xtion sees it, and writes the labelled cloud to a PCD file.

#include "simulation/scene_library.h"
#include "simulation/sensor.h"

#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace ga = grasp_affordances;

namespace
{

pcl::PointCloud<pcl::PointXYZL> labelledCloud(const ga::Frame& frame)
{
  pcl::PointCloud<pcl::PointXYZL> cloud(frame.cloud.width, frame.cloud.height);
  for (std::size_t i = 0; i < frame.cloud.size(); ++i) {
    cloud[i].getVector3fMap() = frame.cloud.point(i);
    cloud[i].label = frame.labels[i];
  }
  cloud.is_dense = false;
  return cloud;
}

void printSummary(const std::string& file, const ga::Frame& frame)
{
  std::size_t measured = 0;
  std::map<std::uint32_t, std::size_t> points;
  for (std::size_t i = 0; i < frame.cloud.size(); ++i) {
    if (!frame.cloud.measured(i))
      continue;
    ++measured;
    if (frame.labels[i] != 0)
      ++points[frame.labels[i]];
  }
  std::cout << file << ": " << frame.cloud.width << " x " << frame.cloud.height << ", " << measured
            << " points measured";
  for (const auto& [label, count] : points)
    std::cout << ", " << count << " of affordance " << label;
  std::cout << '\n';
}

void listScenes()
{
  for (const ga::NamedScene& scene : ga::sceneLibrary())
    std::cout << scene.name << ": " << scene.description << '\n';
}

}  // namespace

int main(int argc, char** argv)
{
  std::string scene, out;
  std::uint64_t seed = 1;
  bool list = false;

  std::vector<std::string> names;
  for (const ga::NamedScene& named : ga::sceneLibrary())
    names.push_back(named.name);

  CLI::App app(
      "Renders a scene as a virtual Asus Xtion sees it: an organized 640 x 480 cloud in the optical frame, "
      "metres, NaN where nothing is measured, with a label per point (0: not graspable, 1..: affordance).");
  auto* list_flag = app.add_flag("--list", list, "list the scenes and exit");
  app.add_option("--scene", scene, "name of the scene")->check(CLI::IsMember(names))->excludes(list_flag);
  app.add_option("--seed", seed, "of sizes, places and noise")
      ->check(CLI::Range(std::int64_t{0}, (std::int64_t{1} << 53) - 1))
      ->capture_default_str();
  app.add_option("--out", out, "PCD file to write (fields x y z label, compressed)");
  try {
    app.parse(argc, argv);
    if (!list && scene.empty())
      throw CLI::RequiredError("--scene");
    if (!list && out.empty())
      throw CLI::RequiredError("--out");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }

  if (list) {
    listScenes();
    return 0;
  }
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);  // failures are reported below
  try {
    const ga::View view = ga::makeScene(scene, seed);
    const ga::Frame frame = ga::Xtion().capture(view.scene, view.T_scene_camera, seed);
    pcl::PCDWriter().writeBinaryCompressed(out, labelledCloud(frame));
    printSummary(out, frame);
  } catch (const std::exception& error) {
    const std::string reason = error.what();  // PCL's begins with a colon
    std::cerr << "simulate: cannot write " << out << ": "
              << reason.substr(std::min(reason.size(), reason.find_first_not_of(": "))) << '\n';
    return 1;
  }
  return 0;
}
