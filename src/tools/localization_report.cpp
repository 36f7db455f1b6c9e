#include "tools/localization_report.h"

#include "tools/json.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace grasp_affordances
{
namespace
{

Json countsJson(const Localization& localization)
{
  Json counts;
  counts["sampled"] = localization.sampled;
  for (std::size_t i = 0; i < kOutcomes; ++i) {
    counts[outcomeName(static_cast<Outcome>(i))] = localization.counts[i];
  }
  return counts;
}

Json timesJson(const StageTimes& times)
{
  Json json;
  json["total"] = times.total;
  json["preparation"] = times.preparation;
  json["neighborhoods"] = times.neighborhoods;
  json["occlusion"] = times.occlusion;
  json["fit"] = times.fit;
  json["shell"] = times.shell;
  json["handles"] = times.handles;
  json["hand_poses"] = times.hand_poses;
  return json;
}

Json quaternionJson(const Eigen::Quaterniond& rotation)
{
  return {rotation.x(), rotation.y(), rotation.z(), rotation.w()};
}

Json viewJson(const ViewSource& view)
{
  Json json;
  json["file"] = view.file;
  json["points"] = view.points;
  json["first_point_index"] = view.first_point_index;
  json["translation"] = vectorJson(view.T_common_cloud.translation());
  json["rotation"] = quaternionJson(Eigen::Quaterniond(view.T_common_cloud.linear()));
  return json;
}

/// null where the normal is not known.
Json normalJson(const Eigen::Vector3d& normal)
{
  return normal.allFinite() ? vectorJson(normal) : Json();
}

Json shellJson(const Shell& shell)
{
  Json json;
  json["centroid"] = vectorJson(shell.centroid);
  json["axis"] = vectorJson(shell.axis);
  json["normal"] = normalJson(shell.normal);
  json["inner_radius"] = shell.inner_radius;
  json["thickness"] = shell.thickness;
  json["length"] = shell.length;
  json["curvature"] = shell.curvature;  // a NaN is written as null
  json["points_inside"] = shell.points_inside;
  json["points_in_gap"] = shell.points_in_gap;
  json["observed_free"] = shell.observed_free;
  json["point_index"] = shell.point_index;
  return json;
}

Json handPoseJson(const GraspPose& hand, const HandPosesConfig& config)
{
  const Eigen::Matrix3d orientation = poseOfHand(hand, config).linear();
  Json json;
  json["position"] = vectorJson(hand.pose.translation());
  json["approach"] = vectorJson(orientation.col(0));
  json["axis"] = vectorJson(orientation.col(2));
  json["quaternion"] = quaternionJson(Eigen::Quaterniond(hand.pose.linear()).normalized());
  json["width"] = hand.width;
  json["observed_free"] = hand.observed_free;
  json["score"] = hand.score;
  return json;
}

Json handleJson(const GraspHandle& handle, const HandPosesConfig& config)
{
  Json json;
  json["id"] = handle.id;
  json["centroid"] = vectorJson(handle.centroid);
  json["axis"] = vectorJson(handle.axis);
  json["normal"] = normalJson(handle.normal);
  json["radius"] = handle.radius;
  json["inner_radius"] = handle.inner_radius;
  json["length"] = handle.length;
  json["polyline"] = Json::array();
  for (const Eigen::Vector3d& point : handle.polyline) {
    json["polyline"].push_back(vectorJson(point));
  }
  json["shells"] = handle.shells;
  json["score"] = handle.score;
  json["agreement"] = handle.agreement;
  json["clearance"] = handle.clearance;
  json["observed_free"] = handle.observed_free;
  json["hand_poses"] = Json::array();
  for (const GraspPose& hand : handle.hand_poses) {
    json["hand_poses"].push_back(handPoseJson(hand, config));
  }
  return json;
}

void printVector(std::ostream& out, const Eigen::Vector3d& vector, int width, int decimals)
{
  out << std::setprecision(decimals);
  for (const double component : {vector.x(), vector.y(), vector.z()}) {
    out << std::setw(width) << component;
  }
}

}  // namespace

std::string CloudSource::name() const
{
  std::string name = file;
  for (std::size_t i = 1; i < views.size(); ++i) {
    name += " + " + views[i].file;
  }
  return name;
}

std::string toJson(const CloudSource& source, const Config& config, const Localization& localization)
{
  Json json;
  json["file"] = source.file;
  json["frame_id"] = source.frame_id;
  json["stamp"] = source.stamp;
  if (!source.views.empty()) {
    json["views"] = Json::array();
    for (const ViewSource& view : source.views) {
      json["views"].push_back(viewJson(view));
    }
    json["view_disagreement"] = localization.view_disagreement;
  }
  json["preset"] = config.preset;
  json["seed"] = config.sampling.seed;
  json["threads"] = localization.threads;
  json["points"] = localization.points;
  json["counts"] = countsJson(localization);
  json["milliseconds"] = timesJson(localization.milliseconds);
  json["shells"] = Json::array();
  for (const Shell& shell : localization.shells) {
    json["shells"].push_back(shellJson(shell));
  }
  json["handles"] = Json::array();
  for (const GraspHandle& handle : localization.handles) {
    json["handles"].push_back(handleJson(handle, config.hand_poses));
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);  // file names need not be UTF-8
}

void printTable(std::ostream& out, const CloudSource& source, const Config& config, const Localization& localization)
{
  constexpr std::size_t kMostRows = 20;
  const auto& handles = localization.handles;
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << source.name() << ": " << handles.size() << " handles in "
       << localization.milliseconds.total << " ms (preset " << config.preset << ", " << localization.threads
       << " threads)\n";
  if (!handles.empty()) {
    text << "  id    centroid [m]               axis                 radius [m]  length [m]  shells  score  hand "
            "poses\n";
  }
  for (std::size_t i = 0; i < std::min(handles.size(), kMostRows); ++i) {
    text << std::setw(4) << handles[i].id;
    printVector(text, handles[i].centroid, 9, 3);
    printVector(text, handles[i].axis, 7, 2);
    text << std::setprecision(3) << std::setw(11) << handles[i].radius << std::setw(12) << handles[i].length
         << std::setw(8) << handles[i].shells.size() << std::setprecision(2) << std::setw(7) << handles[i].score
         << std::setw(12) << handles[i].hand_poses.size() << "\n";
  }
  if (handles.size() > kMostRows) {
    text << "    and " << handles.size() - kMostRows << " more\n";
  }
  text << "    " << localization.shells.size() << " shells from " << localization.sampled << " samples of "
       << localization.points << " points (--json prints them, --picture draws them)\n";
  out << text.str();
}

}  // namespace grasp_affordances
