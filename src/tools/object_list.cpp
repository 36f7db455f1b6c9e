#include "tools/object_list.h"

#include "tools/json.h"

#include <iomanip>
#include <sstream>

namespace grasp_affordances
{
namespace
{

Json cameraJson(const View& view, const SensorModel& model)
{
  const Eigen::Quaterniond orientation(view.T_scene_camera.linear());
  Json json;
  json["width"] = model.width;
  json["height"] = model.height;
  json["fx"] = model.intrinsics.fx;
  json["fy"] = model.intrinsics.fy;
  json["cx"] = model.intrinsics.cx;
  json["cy"] = model.intrinsics.cy;
  json["position"] = vectorJson(view.T_scene_camera.translation());
  json["orientation"] = {orientation.x(), orientation.y(), orientation.z(), orientation.w()};
  return json;
}

Json definitionJson(const GraspDefinition& definition)
{
  Json json;
  json["capture_radius"] = definition.capture_radius;
  json["clearance"] = definition.clearance;
  json["min_length"] = definition.min_length;
  return json;
}

Json affordanceJson(const Affordance& affordance)
{
  Json json;
  json["label"] = affordance.label;
  json["object"] = affordance.object;
  json["radius"] = affordance.radius;
  json["length"] = affordance.length;
  json["distance"] = affordance.distance;
  json["axis"] = Json::array();
  for (const Eigen::Vector3d& point : affordance.axis)
    json["axis"].push_back(vectorJson(point));
  json["visible_points"] = affordance.visible_points;
  json["occluded_share"] = affordance.occluded_share;
  return json;
}

}  // namespace

std::string objectList(const std::string& scene, std::uint64_t seed, const View& view, const SensorModel& model,
                       const GraspDefinition& definition, const GroundTruth& truth)
{
  Json json;
  json["scene"] = scene;
  json["seed"] = seed;
  json["camera"] = cameraJson(view, model);
  json["definition"] = definitionJson(definition);
  json["objects"] = view.scene.objects();
  json["affordances"] = Json::array();
  for (const Affordance& affordance : truth.affordances)
    json["affordances"].push_back(affordanceJson(affordance));
  return json.dump();
}

std::string affordanceTable(const GroundTruth& truth)
{
  std::ostringstream text;
  text << std::fixed;
  for (const Affordance& affordance : truth.affordances) {
    text << std::setw(4) << affordance.label << "  " << affordance.object << std::setprecision(1) << ": radius "
         << 1000.0 * affordance.radius << " mm, length " << 1000.0 * affordance.length << " mm, "
         << affordance.visible_points << " points, " << std::setprecision(0) << 100.0 * affordance.occluded_share
         << " % occluded\n";
  }
  return text.str();
}

}  // namespace grasp_affordances
