#include "simulation/sensor_model.h"

#include "core/config/range_check.h"
#include "core/config/yaml_values.h"
#include "simulation/embedded_file.h"

#include <algorithm>
#include <stdexcept>

namespace grasp_affordances
{
namespace
{

constexpr double kMillimetre = 0.001;

}  // namespace

SensorModel SensorModel::unregistered() const
{
  SensorModel result = *this;
  if (registered()) {
    result.width = depth_camera.width;
    result.height = depth_camera.height;
    result.intrinsics = depth_camera.intrinsics;
    result.depth_camera = DepthCameraModel();
  }
  return result;
}

double SensorModel::depthQuantum(double depth_m) const
{
  if (principle == SensorPrinciple::time_of_flight)
    return kMillimetre;
  const double focal = registered() ? depth_camera.intrinsics.fx : intrinsics.fx;
  return depth_m * depth_m / (focal * projector_x) * disparity_step;
}

template <>
const std::vector<std::string>& enumWords<SensorPrinciple>()
{
  static const std::vector<std::string> words{"structured_light", "stereo", "time_of_flight"};
  return words;
}

template <>
SensorPrinciple enumFromWord<SensorPrinciple>(const std::string& name, const std::string& word)
{
  return findWord<SensorPrinciple>(name, word);
}

void validate(const SensorModel& model)
{
  visitSensor(model, RangeCheck());
  if (!(model.min_depth < model.max_depth))
    throw ParameterError("range/max: it is not above range/min");
  const bool flight = model.principle == SensorPrinciple::time_of_flight;
  if (flight != (model.projector_x == 0.0)) {
    throw ParameterError(flight ? "projector_x: it must be 0 for time of flight"
                                : "projector_x: it must not be 0 for a sensor that triangulates");
  }
  const SensorModel::DepthCameraModel& own = model.depth_camera;
  if (own.width > 0 && !(own.height > 0 && own.intrinsics.fx > 0.0 && own.intrinsics.fy > 0.0))
    throw ParameterError("depth_camera/width: with it height, fx and fy must be given");
}

const std::vector<std::string>& sensorNames()
{
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const EmbeddedFile& file : sensorFiles())
      result.emplace_back(file.name);
    return result;
  }();
  return names;
}

SensorModel sensorModel(const std::string& name)
{
  for (const EmbeddedFile& file : sensorFiles()) {
    if (name == file.name)
      return sensorModelFromYaml(file.text);
  }
  throw std::invalid_argument("there is no sensor '" + oneLine(name) + "'; there are " + listed(sensorNames()));
}

SensorModel sensorModelFromYaml(const std::string& text)
{
  return withOneLineErrors([&] {
    YamlValues values(text);
    SensorModel model;
    visitSensor(model, values);
    values.refuseRemaining();
    validate(model);
    return model;
  });
}

SensorModel sensorModelFromFile(const std::string& path)
{
  return parsedFile(path, sensorModelFromYaml);
}

SensorModel sensorModelFromNameOrFile(const std::string& name_or_path)
{
  const std::string ending = ".yaml";
  const bool file = name_or_path.size() > ending.size() &&
                    name_or_path.compare(name_or_path.size() - ending.size(), ending.size(), ending) == 0;
  return file ? sensorModelFromFile(name_or_path) : sensorModel(name_or_path);
}

}  // namespace grasp_affordances
