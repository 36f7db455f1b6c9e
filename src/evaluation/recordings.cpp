#include "evaluation/recordings.h"

#include "io/pcd.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <utility>

namespace grasp_affordances
{
namespace
{

using Json = nlohmann::json;

struct Recording
{
  std::string path;  // of the PCD file
  double capture_radius;
  std::size_t affordances;                        // their number
  std::map<std::uint32_t, std::uint32_t> labels;  // of objects, to those of affordances or doubtful
};

Recording parse(const std::string& path, double capture_radius, const Json& scene)
{
  Recording recording{path, capture_radius, scene.at("affordances").size(), {}};
  if (recording.affordances >= kDoubtful) {
    throw std::runtime_error("more affordances than labels");
  }
  for (const std::uint32_t object : scene.at("ignore")) {
    recording.labels[object] = kDoubtful;
  }
  std::uint32_t label = 0;
  for (const Json& objects : scene.at("affordances")) {
    ++label;
    for (const std::uint32_t object : objects) {
      recording.labels[object] = label;
    }
  }
  return recording;
}

std::vector<std::uint32_t> objectLabels(const pcl::PCLPointCloud2& message)
{
  for (const pcl::PCLPointField& field : message.fields) {
    if (field.name == "label" && field.datatype == pcl::PCLPointField::UINT32 && field.count == 1) {
      std::vector<std::uint32_t> labels(std::size_t{message.width} * message.height);
      for (std::size_t i = 0; i < labels.size(); ++i) {
        std::memcpy(&labels[i], &message.data[i * message.point_step + field.offset], sizeof(std::uint32_t));
      }
      return labels;
    }
  }
  throw std::runtime_error("no field label of type UINT32");
}

LabelledCloud load(const Recording& recording)
{
  LabelledCloud labelled;
  labelled.capture_radius = recording.capture_radius;
  try {
    SensorPose viewpoint;
    const pcl::PCLPointCloud2 message = readPcd(recording.path, &viewpoint);
    labelled.cloud.sensor_origin = viewpoint.position.cast<float>();
    cloudFromPointCloud2(message, labelled.cloud);
    labelled.labels = objectLabels(message);
  } catch (const std::exception& error) {
    throw std::runtime_error(recording.path + ": " + error.what());
  }
  for (std::uint32_t label = 1; label <= recording.affordances; ++label) {
    Affordance affordance;
    affordance.label = label;
    affordance.radius = affordance.length = affordance.distance = affordance.occluded_share = std::nan("");
    labelled.affordances.push_back(affordance);
  }
  for (std::size_t i = 0; i < labelled.labels.size(); ++i) {
    const auto found = recording.labels.find(labelled.labels[i]);
    const std::uint32_t label = found == recording.labels.end() ? kNotGraspable : found->second;
    labelled.labels[i] = label;
    if (label != kNotGraspable && label != kDoubtful && labelled.cloud.measured(i)) {
      ++labelled.affordances[label - 1].visible_points;
    }
  }
  return labelled;
}

}  // namespace

std::vector<EvaluationFrame> recordedFrames(const std::string& labels_file)
{
  std::ifstream stream(labels_file);
  if (!stream) {
    throw std::runtime_error(labels_file + ": cannot be read");
  }
  std::vector<EvaluationFrame> frames;
  try {
    const Json root = Json::parse(stream);
    const std::filesystem::path folder = std::filesystem::path(labels_file).parent_path();
    for (const auto& [name, scene] : root.at("scenes").items()) {
      const Recording recording = parse((folder / (name + ".pcd")).string(), root.at("capture_radius"), scene);
      frames.push_back({"recorded", name, 0, [recording] { return load(recording); }});
    }
  } catch (const std::exception& error) {
    throw std::runtime_error(labels_file + ": " + error.what());
  }
  return frames;
}

}  // namespace grasp_affordances
