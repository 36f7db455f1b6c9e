// Prints what depth images tell about their sensor: noise about planes, what happens at depth edges, holes.

#include "evaluation/sensor_statistics.h"
#include "io/pcd.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace ga = grasp_affordances;

namespace
{

void print(const char* name, const ga::EdgeProfile& edge)
{
  std::printf("  edges %-8s %6zu: ramp %4.1f px, hole %4.1f px, with hole %3.0f %%, shadow %4.0f mm\n", name,
              edge.edges, edge.ramp, edge.hole, 100.0 * edge.with_hole, 1000.0 * edge.shadow);
}

void print(const std::string& file, const ga::SensorStatistics& statistics)
{
  std::printf("%s: holes %.1f %%, within surfaces %.2f %%\n", file.c_str(), 100.0 * statistics.holes,
              100.0 * statistics.surface_holes);
  print("left", statistics.left);
  print("right", statistics.right);
  print("vertical", statistics.vertical);
  for (const ga::PlaneNoise& noise : statistics.noise)
    std::printf("  noise at %.2f m: %5.2f mm (%zu patches)\n", noise.depth, 1000.0 * noise.deviation, noise.patches);
}

int statisticsMain(int argc, char** argv)
{
  std::vector<std::string> files;
  CLI::App app(
      "Prints what organized clouds tell about their sensor: noise about planes by depth, ramps and holes at "
      "depth edges, share of holes.");
  app.add_option("FILE", files, "PCD files, organized, in the optical frame")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  int status = 0;
  for (const std::string& file : files) {
    try {
      const ga::Cloud cloud = ga::readPcdCloud(file);
      if (!cloud.organized())
        throw std::runtime_error("the cloud is not organized");
      print(file, ga::sensorStatistics(cloud));
    } catch (const std::exception& error) {
      std::cerr << "sensor_statistics: " << file << ": " << error.what() << '\n';
      status = 1;
    }
  }
  return status;
}

}  // namespace

int main(int argc, char** argv)
{
  try {
    return statisticsMain(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "sensor_statistics: " << error.what() << '\n';
    return 1;
  }
}
