#include "evaluation/handle_report.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

namespace grasp_affordances
{
namespace
{

using Json = nlohmann::json;

constexpr double kDegreesPerRadian = 57.29577951308232;
constexpr double kMillimetresPerMetre = 1000.0;

const HandlesPerAffordance& ofClass(const HandleScore& score, std::string_view key)
{
  const auto visibility = std::find_if(kVisibilityClasses.begin(), kVisibilityClasses.end(),
                                       [&](const VisibilityClass& candidate) { return candidate.key == key; });
  return score.affordances[static_cast<std::size_t>(visibility - kVisibilityClasses.begin())];
}

std::string measured(double value, double scale)
{
  return std::isfinite(value) ? text("%.1f", scale * value) : "–";
}

std::string measured(const Spread& spread, double scale)
{
  return measured(spread.median, scale) + " / " + measured(spread.p90, scale);
}

std::string exactlyOne(const HandlesPerAffordance& counts)
{
  const std::string share = percent(counts.exactlyOne().value(), counts.interval);
  return counts.affordances() > 0 ? share + " of " + std::to_string(counts.affordances()) : share;
}

Json json(const Interval& interval)
{
  return std::isnan(interval.low) ? Json() : Json{interval.low, interval.high};
}

Json json(const Spread& spread, double scale)
{
  return {{"median", scale * spread.median}, {"p90", scale * spread.p90}, {"count", spread.count}};
}

std::string markdownRow(const SummaryRow& row)
{
  const HandleScore& s = row.handles;
  const HandlesPerAffordance& shown = ofClass(s, "200");
  std::ostringstream line;
  line << "| " << sceneCell(row) << " | " << row.score.frames << " × " << row.score.runs << " | " << s.precision.part
       << " | " << s.wrong() << " | " << percent(s.precision.value(), s.interval) << " | " << exactlyOne(shown) << " | "
       << exactlyOne(ofClass(s, "200_clear")) << " | " << shown.none << " | " << shown.several << " | "
       << measured(s.center, kMillimetresPerMetre) << " | " << measured(s.axis, kDegreesPerRadian) << " | "
       << measured(s.radius, kMillimetresPerMetre) << " | " << measured(s.radius_bias, kMillimetresPerMetre) << " |\n";
  return line.str();
}

}  // namespace

void writeHandles(const std::string& path, const Evaluation& evaluation)
{
  CsvTable table(
      "scene,seed,run,preset,estimator,views,samples,importance,id,verdict,affordance,x,y,z,axis_x,axis_y,axis_z,"
      "radius,inner_radius,length,polyline_points,support,score,agreement,clearance,observed_free,hand_poses,center_"
      "error,"
      "axis_error_degrees,radius_error");
  for (const FrameResult& frame : evaluation.frames) {
    for (std::size_t variation = 0; variation < evaluation.variations.size(); ++variation) {
      const auto& [config, views] = evaluation.variations[variation];
      for (std::size_t run = 0; run < frame.runs[variation].size(); ++run) {
        for (const JudgedHandle& judged : frame.runs[variation][run].handles) {
          const GraspHandle& h = judged.handle;
          table.addRow(frame.scene, frame.seed, run + 1, config.preset, estimatorName(config), views,
                       config.sampling.samples, onOrOff(config.sampling.importance), h.id,
                       verdictName(judged.verdict.kind), judged.verdict.affordance, h.centroid.x(), h.centroid.y(),
                       h.centroid.z(), h.axis.x(), h.axis.y(), h.axis.z(), h.radius, h.inner_radius, h.length,
                       h.polyline.size(), h.shells.size(), h.score, h.agreement, h.clearance, h.observed_free,
                       judged.hand_poses, judged.errors.center, kDegreesPerRadian * judged.errors.axis,
                       judged.errors.radius);
        }
      }
    }
  }
  table.save(path);
}

std::string handleColumns()
{
  std::string columns =
      ",handles_right,handles_wrong,handles_not_counted,handle_precision,handle_precision_low,handle_precision_high,"
      "center_error_median,center_error_p90,axis_error_degrees_median,axis_error_degrees_p90,radius_error_median,"
      "radius_error_p90,radius_bias";
  for (const VisibilityClass& visibility : kVisibilityClasses) {
    const std::string key = visibility.key;
    columns += ",handles_none_" + key + ",handles_one_" + key + ",handles_several_" + key + ",exactly_one_" + key;
  }
  return columns;
}

void addHandleColumns(const HandleScore& s, CsvTable& table)
{
  table.add(s.precision.part, s.wrong(), s.not_counted, s.precision.value(), s.interval.low, s.interval.high,
            s.center.median, s.center.p90, kDegreesPerRadian * s.axis.median, kDegreesPerRadian * s.axis.p90,
            s.radius.median, s.radius.p90, s.radius_bias);
  for (const HandlesPerAffordance& counts : s.affordances) {
    table.add(counts.none, counts.one, counts.several, counts.exactlyOne().value());
  }
}

Json handleJson(const HandleScore& s)
{
  Json affordances;
  for (std::size_t i = 0; i < kVisibilityClasses.size(); ++i) {
    const HandlesPerAffordance& counts = s.affordances[i];
    affordances[kVisibilityClasses[i].key] = {{"none", counts.none},
                                              {"one", counts.one},
                                              {"several", counts.several},
                                              {"exactly_one", counts.exactlyOne().value()},
                                              {"interval", json(counts.interval)}};
  }
  return {{"right", s.precision.part},
          {"wrong", s.wrong()},
          {"not_counted", s.not_counted},
          {"precision", s.precision.value()},
          {"interval", json(s.interval)},
          {"center_error", json(s.center, 1.0)},
          {"axis_error_degrees", json(s.axis, kDegreesPerRadian)},
          {"radius_error", json(s.radius, 1.0)},
          {"radius_bias", s.radius_bias},
          {"affordances", affordances}};
}

std::string markdownHandleTables(const Evaluation& evaluation, const std::vector<SummaryRow>& rows)
{
  std::ostringstream tables;
  for (std::size_t variation = 0; variation < evaluation.variations.size(); ++variation) {
    tables << (variation > 0 ? "\n" : "") << "Handles. " << variationTitle(evaluation, variation)
           << ". Precision and shares in percent, with 95 % intervals; errors: median / 90th percentile.\n\n"
           << "| scene | frames × runs | right | wrong | precision | exactly one: ≥ 200 points | exactly one: ≥ 200, "
              "less than half occluded | none: ≥ 200 | several: ≥ 200 | centre, mm | axis, ° | radius, mm | radius "
              "bias, mm |\n|---|";
    for (int column = 0; column < 12; ++column) {
      tables << "---|";
    }
    tables << "\n";
    for (const SummaryRow& row : rows) {
      if (row.variation == variation) {
        tables << markdownRow(row);
      }
    }
  }
  return tables.str();
}

}  // namespace grasp_affordances
