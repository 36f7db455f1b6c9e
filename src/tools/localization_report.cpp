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
  return json;
}

Json viewJson(const ViewSource& view)
{
  const Eigen::Quaterniond rotation(view.T_common_cloud.linear());
  Json json;
  json["file"] = view.file;
  json["points"] = view.points;
  json["first_point_index"] = view.first_point_index;
  json["translation"] = vectorJson(view.T_common_cloud.translation());
  json["rotation"] = {rotation.x(), rotation.y(), rotation.z(), rotation.w()};
  return json;
}

Json shellJson(const Shell& shell)
{
  Json json;
  json["centroid"] = vectorJson(shell.centroid);
  json["axis"] = vectorJson(shell.axis);
  json["normal"] = vectorJson(shell.normal);
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
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);  // file names need not be UTF-8
}

void printTable(std::ostream& out, const CloudSource& source, const Config& config, const Localization& localization)
{
  constexpr std::size_t kMostRows = 10;
  const auto& shells = localization.shells;
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << source.name() << ": " << shells.size() << " shells from "
       << localization.sampled << " samples of " << localization.points << " points in "
       << localization.milliseconds.total << " ms (preset " << config.preset << ", " << localization.threads
       << " threads)\n";
  if (!shells.empty()) {
    text << "    centroid [m]               axis                 radius [m]  length [m]  points\n";
  }
  for (std::size_t i = 0; i < std::min(shells.size(), kMostRows); ++i) {
    printVector(text, shells[i].centroid, 9, 3);
    printVector(text, shells[i].axis, 7, 2);
    text << std::setprecision(3) << std::setw(11) << shells[i].inner_radius << std::setw(12) << shells[i].length
         << std::setw(10) << shells[i].points_inside << "\n";
  }
  if (shells.size() > kMostRows) {
    text << "    and " << shells.size() - kMostRows << " more (--json prints all, --picture draws them)\n";
  }
  out << text.str();
}

}  // namespace grasp_affordances
