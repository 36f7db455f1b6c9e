// Renders a scene as the virtual Xtion sees it, and writes the labelled cloud, the depth image and the list of objects.

#include "simulation/background.h"
#include "simulation/camera_orbit.h"
#include "simulation/camera_pose.h"
#include "simulation/ground_truth.h"
#include "simulation/placement.h"
#include "simulation/scene_library.h"
#include "simulation/sensor.h"
#include "simulation/sensor_model.h"
#include "tools/number_range.h"
#include "tools/object_list.h"

#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <png.h>
#include <CLI/CLI.hpp>
#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <fstream>
#include <functional>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace ga = grasp_affordances;

namespace
{

/// The points in the optical frame, and its pose in the scene's as VIEWPOINT.
void writeCloud(const std::string& file, const ga::Frame& frame, const Eigen::Isometry3d& T_scene_camera,
                const std::vector<std::uint32_t>& labels)
{
  pcl::PointCloud<pcl::PointXYZL> cloud(frame.cloud.width, frame.cloud.height);
  for (std::size_t i = 0; i < frame.cloud.size(); ++i) {
    cloud[i].getVector3fMap() = frame.cloud.point(i);
    cloud[i].label = labels[i];
  }
  cloud.is_dense = false;
  cloud.sensor_origin_.head<3>() = T_scene_camera.translation().cast<float>();
  cloud.sensor_orientation_ = Eigen::Quaterniond(T_scene_camera.linear()).cast<float>();
  pcl::PCDWriter().writeBinaryCompressed(file, cloud);
}

void writeDepth(const std::string& file, const ga::Frame& frame)
{
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = frame.cloud.width;
  image.height = frame.cloud.height;
  image.format = PNG_FORMAT_LINEAR_Y;  // 16 bits, written as they are
  if (png_image_write_to_file(&image, file.c_str(), 0, frame.depth.data(), 0, nullptr) == 0)
    throw std::runtime_error(image.message);
}

void writeText(const std::string& file, const std::string& text)
{
  std::ofstream stream(file, std::ios::binary);
  stream << text << '\n';
  stream.close();
  if (!stream)
    throw std::runtime_error("not writable");
}

/// Writes a file that is asked for. @return whether nothing went wrong
bool written(const std::string& file, const std::function<void()>& write)
{
  if (file.empty())
    return true;
  try {
    write();
    return true;
  } catch (const std::exception& error) {
    const std::string reason = error.what();  // PCL's begins with a colon
    std::cerr << "simulate: cannot write " << file << ": "
              << reason.substr(std::min(reason.size(), reason.find_first_not_of(": "))) << '\n';
    return false;
  }
}

std::string sensorList()
{
  std::string list;
  for (const std::string& name : ga::sensorNames())
    list += (list.empty() ? "" : ", ") + name;
  return list;
}

void listScenes()
{
  for (const ga::NamedScene& scene : ga::sceneLibrary())
    std::cout << scene.name << ": " << scene.description << '\n';
}

bool standardOutputWritten()
{
  if (std::cout.flush())
    return true;
  std::cerr << "simulate: cannot write to stdout\n";
  return false;
}

int simulateMain(int argc, char** argv)
{
  std::string scene, sensor = "xtion", background = "walls", out, depth, objects;
  std::uint64_t seed = 1, noise_seed = 0;
  double turn = 0.0;
  std::optional<double> tilt, distance;
  ga::GraspDefinition definition;
  bool list = false;

  std::vector<std::string> names;
  for (const ga::NamedScene& named : ga::sceneLibrary())
    names.push_back(named.name);

  CLI::App app(
      "Renders a scene as a depth camera sees it: an organized cloud in the optical frame, metres, NaN where nothing "
      "is measured, with a label per point (0: not graspable, 1..: affordance, 255: "
      "doubtful).");
  auto* list_flag = app.add_flag("--list", list, "list the scenes and exit");
  app.add_option("--scene", scene, "name of the scene")->check(CLI::IsMember(names))->excludes(list_flag);
  app.add_option("--background", background, "what is behind the things")
      ->check(CLI::IsMember(ga::backgroundNames()))
      ->capture_default_str();
  app.add_option("--sensor", sensor, "name of the depth camera, or a file of one, *.yaml (known: " + sensorList() + ")")
      ->capture_default_str();
  app.add_option("--seed", seed, "of sizes, places and noise")
      ->check(CLI::Range(std::int64_t{0}, (std::int64_t{1} << 53) - 1))
      ->capture_default_str();
  app.add_option("--turn", turn,
                 "degrees: turns the camera about the vertical through the point that it looks at; counter-clockwise "
                 "as seen from above")
      ->check(ga::numberRange(-180.0, 180.0))
      ->capture_default_str();
  app.add_option("--tilt", tilt, "degrees by which the camera looks down; the scene's own if not given")
      ->check(ga::numberRange(0.0, 75.0));
  app.add_option("--distance", distance,
                 "of the camera from the point that it looks at, m; the scene's own if not given")
      ->check(ga::numberRange(0.4, 1.5));
  app.add_option("--noise-seed", noise_seed, "added to the seed for the noise: cameras that see one scene differ in it")
      ->check(CLI::Range(std::int64_t{0}, (std::int64_t{1} << 53) - 1))
      ->capture_default_str();
  app.add_option("--capture-radius", definition.capture_radius, "of the hand that the labels hold for, m")
      ->check(ga::numberRange(0.002, 0.5))
      ->capture_default_str();
  app.add_option("--out", out,
                 "PCD file to write (fields x y z label, compressed; VIEWPOINT: the camera's pose in the scene)");
  app.add_option("--depth", depth, "PNG file to write: depth image, 16 bits, mm, 0 where nothing is measured");
  app.add_option("--objects", objects, "JSON file to write: camera, objects and affordances");
  try {
    app.parse(argc, argv);
    if (!list && scene.empty())
      throw CLI::RequiredError("--scene");
    if (!list && out.empty() && depth.empty() && objects.empty())
      throw CLI::RequiredError("--out, --depth or --objects");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }

  if (list) {
    listScenes();
    return standardOutputWritten() ? 0 : 1;
  }
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);  // failures are reported by written()
  ga::SensorModel model;
  try {
    model = ga::sensorModelFromNameOrFile(sensor);
  } catch (const std::exception& error) {
    std::cerr << "simulate: --sensor: " << error.what() << '\n';
    return 2;
  }
  ga::View view;
  try {
    ga::CameraPose pose{tilt, distance};
    if (pose.tilt)
      *pose.tilt *= ga::kDegree;
    view = ga::viewFromAside(ga::makeScene(scene, seed, ga::backgroundFromName(background), pose), ga::kDegree * turn);
  } catch (const std::exception& error) {  // not every seed leaves room for everything
    std::cerr << "simulate: " << scene << ", seed " << seed << ": " << error.what() << '\n';
    return 1;
  }
  const ga::Frame frame = ga::DepthCamera(model).capture(view.scene, view.T_scene_camera, seed + noise_seed);
  const ga::GroundTruth truth = ga::groundTruth(view, frame, model, definition);

  bool good = written(out, [&] { writeCloud(out, frame, view.T_scene_camera, truth.labels); });
  good &= written(depth, [&] { writeDepth(depth, frame); });
  good &= written(objects, [&] { writeText(objects, ga::objectList(scene, seed, view, model, definition, truth)); });
  std::size_t measured = 0;
  for (std::size_t i = 0; i < frame.cloud.size(); ++i)
    measured += frame.cloud.measured(i) ? 1 : 0;
  std::cout << scene << ", seed " << seed << ": " << measured << " of " << frame.cloud.size() << " points measured, "
            << truth.affordances.size() << " affordances\n"
            << ga::affordanceTable(truth);
  return good && standardOutputWritten() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv)
{
  try {
    return simulateMain(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "simulate: " << error.what() << '\n';
    return 1;
  }
}
