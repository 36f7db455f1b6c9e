#include "evaluation/recordings.h"

#include "core/config/one_line.h"
#include "io/pcd.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
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

/// What is not as it should be. Only the kind of what may be nested however deeply: that is written by recursion.
std::string quoted(const Json& value)
{
  const bool is_nested = value.is_structured();
  return is_nested ? value.type_name() : value.dump(-1, ' ', true, Json::error_handler_t::replace);
}

const Json& list(const Json& value)
{
  if (!value.is_array()) {
    throw std::runtime_error(quoted(value) + " is no list");
  }
  return value;
}

/// What points say that are on an object.
std::uint32_t objectLabel(const Json& value)
{
  const auto most = std::numeric_limits<std::uint32_t>::max();
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most) {
    throw std::runtime_error(quoted(value) + " is no label of an object");
  }
  return value.get<std::uint32_t>();
}

Recording parse(const std::string& path, double capture_radius, const Json& scene)
{
  const Json& affordances = list(scene.at("affordances"));
  Recording recording{path, capture_radius, affordances.size(), {}};
  if (recording.affordances >= kDoubtful) {
    throw std::runtime_error("more affordances than labels");
  }
  for (const Json& object : list(scene.at("ignore"))) {
    recording.labels[objectLabel(object)] = kDoubtful;
  }
  std::uint32_t label = 0;
  for (const Json& objects : affordances) {
    ++label;
    for (const Json& object : list(objects)) {
      recording.labels[objectLabel(object)] = label;
    }
  }
  return recording;
}

double captureRadius(const Json& value)
{
  const double radius = value.get<double>();
  if (!std::isfinite(radius) || radius <= 0.0) {
    throw std::runtime_error("capture_radius is no length above zero");
  }
  return radius;
}

/// The file of a scene, beside that of the labels: a name that leads elsewhere is none.
std::string fileOf(const std::string& scene)
{
  const auto is_separator = [](unsigned char c) { return c == '/' || std::iscntrl(c) != 0; };
  constexpr std::size_t kLongest = 200;
  if (scene.empty() || scene.size() > kLongest || std::any_of(scene.begin(), scene.end(), is_separator)) {
    throw std::runtime_error("'" + scene + "' is no name of a scene");
  }
  return scene + ".pcd";
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

/// What `read` takes from the content of a file. @throw std::runtime_error, with path and reason
template <class Reader>
auto readLabels(const std::string& path, const Reader& read)
{
  std::ifstream stream(path);
  if (!stream) {
    throw std::runtime_error(path + ": cannot be read");
  }
  try {
    return read(Json::parse(stream));
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": " + oneLine(error.what()));
  }
}

}  // namespace

std::vector<EvaluationFrame> recordedFrames(const std::string& labels_file, const std::string& set)
{
  return readLabels(labels_file, [&](const Json& root) {
    std::vector<EvaluationFrame> frames;
    const std::filesystem::path folder = std::filesystem::path(labels_file).parent_path();
    const double capture_radius = captureRadius(root.at("capture_radius"));
    const Json& scenes = root.at("scenes");
    if (!scenes.is_object()) {
      throw std::runtime_error("scenes is no object");
    }
    for (const auto& [name, scene] : scenes.items()) {
      const Recording recording = parse((folder / fileOf(name)).string(), capture_radius, scene);
      frames.push_back({set.empty() ? "recorded" : set, set.empty() ? name : set + "." + name, 0,
                        [recording] { return load(recording); }});
    }
    return frames;
  });
}

double recordedCaptureRadius(const std::string& labels_file)
{
  return readLabels(labels_file, [](const Json& root) { return captureRadius(root.at("capture_radius")); });
}

std::vector<std::string> recordedSets(const std::vector<std::string>& labels_files)
{
  std::vector<std::string> sets;
  for (const std::string& file : labels_files) {
    const std::filesystem::path path = std::filesystem::absolute(file);
    sets.push_back(path.parent_path().filename().string() + "." + path.stem().string());
    if (std::count(sets.begin(), sets.end(), sets.back()) > 1) {
      throw std::runtime_error(file + ": there are two sets of labels '" + sets.back() + "'");
    }
  }
  return sets;
}

std::vector<EvaluationFrame> recordedFrames(const std::vector<std::string>& labels_files)
{
  if (labels_files.size() == 1) {
    return recordedFrames(labels_files.front());
  }
  const std::vector<std::string> sets = recordedSets(labels_files);
  std::vector<EvaluationFrame> frames;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    for (EvaluationFrame& frame : recordedFrames(labels_files[i], sets[i])) {
      frames.push_back(std::move(frame));
    }
  }
  return frames;
}

}  // namespace grasp_affordances
