#include "evaluation/report.h"

#include "evaluation/handle_report.h"
#include "evaluation/report_format.h"
#include "evaluation/sample_report.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

namespace grasp_affordances
{
namespace
{

using Json = nlohmann::json;

void writeShells(const std::string& path, const Evaluation& evaluation)
{
  CsvTable table(
      "scene,seed,run,preset,estimator,views,shell,verdict,affordance,x,y,z,axis_x,axis_y,axis_z,inner_radius,length,"
      "curvature,observed_free,points_inside,points_in_gap,point_index,samples,importance");
  for (const FrameResult& frame : evaluation.frames) {
    for (std::size_t variation = 0; variation < evaluation.variations.size(); ++variation) {
      const auto& [config, views] = evaluation.variations[variation];
      for (std::size_t run = 0; run < frame.runs[variation].size(); ++run) {
        const auto& shells = frame.runs[variation][run].shells;
        for (std::size_t i = 0; i < shells.size(); ++i) {
          const Shell& s = shells[i].shell;
          const Verdict& verdict = shells[i].verdict;
          table.addRow(frame.scene, frame.seed, run + 1, config.preset, estimatorName(config), views, i,
                       verdictName(verdict.kind), verdict.affordance, s.centroid.x(), s.centroid.y(), s.centroid.z(),
                       s.axis.x(), s.axis.y(), s.axis.z(), s.inner_radius, s.length, s.curvature, s.observed_free,
                       s.points_inside, s.points_in_gap, s.point_index, config.sampling.samples,
                       onOrOff(config.sampling.importance));
        }
      }
    }
  }
  table.save(path);
}

void writeAffordances(const std::string& path, const Evaluation& evaluation)
{
  CsvTable table(
      "scene,seed,preset,estimator,views,label,object,visible_points,visible_elsewhere,occluded_share,distance,radius,"
      "length,runs,found,chance,handles_none,handles_one,handles_several,samples,importance");
  for (const FrameResult& frame : evaluation.frames) {
    for (std::size_t variation = 0; variation < evaluation.variations.size(); ++variation) {
      const auto& [config, views] = evaluation.variations[variation];
      for (std::size_t i = 0; i < frame.affordances.size(); ++i) {
        const Affordance& a = frame.affordances[i];
        std::size_t found = 0, no_handle = 0, one_handle = 0;
        double chances = 0.0;
        for (const Run& run : frame.runs[variation]) {
          found += finds(run, a.label) ? 1 : 0;
          const std::size_t handles = handlesOn(run, a.label);
          no_handle += handles == 0 ? 1 : 0;
          one_handle += handles == 1 ? 1 : 0;
          chances += samplingChance(visiblePoints(frame, i, views), pointsIn(frame, views), run.sampled);
        }
        table.addRow(frame.scene, frame.seed, config.preset, estimatorName(config), views, a.label, a.object,
                     a.visible_points, visibleElsewhere(frame, i), a.occluded_share, a.distance, a.radius, a.length,
                     evaluation.runs, found, chances / static_cast<double>(evaluation.runs), no_handle, one_handle,
                     evaluation.runs - no_handle - one_handle, config.sampling.samples,
                     onOrOff(config.sampling.importance));
      }
    }
  }
  table.save(path);
}

void writeSummary(const std::string& path, const Evaluation& evaluation, const std::vector<SummaryRow>& rows)
{
  std::string header =
      "scene,group,preset,estimator,views,frames,runs,right,wrong,not_counted,wrong_per_run,precision,precision_low,"
      "precision_high,unit_precision,unit_precision_low,unit_precision_high,taubin_difference,taubin_difference_low,"
      "taubin_difference_high";
  for (const VisibilityClass& visibility : kVisibilityClasses) {
    const std::string key = visibility.key;
    header += ",affordances_" + key + ",found_" + key + ",recall_" + key + ",chance_" + key;
  }
  CsvTable table(header + ",samples,importance" + handleColumns());
  for (const SummaryRow& row : rows) {
    const auto& [config, views] = evaluation.variations[row.variation];
    const Score& s = row.score;
    const Mean difference = row.taubin_difference.value_or(Mean());
    table.add(row.scene, row.is_group ? 1 : 0, config.preset, estimatorName(config), views, s.frames, s.runs,
              s.precision.part, s.wrong(), s.not_counted, s.wrongPerRun(), s.precision.value(), s.interval.low,
              s.interval.high, s.unit_precision.value, s.unit_precision.interval.low, s.unit_precision.interval.high,
              difference.value, difference.interval.low, difference.interval.high);
    for (const Recall& recall : s.recall) {
      table.add(recall.found.whole, recall.found.part, recall.found.value(), recall.chance);
    }
    table.add(config.sampling.samples, onOrOff(config.sampling.importance));
    addHandleColumns(row.handles, table);
    table.endRow();
  }
  table.save(path);
}

Json json(const Interval& interval)
{
  return std::isnan(interval.low) ? Json() : Json{interval.low, interval.high};
}

Json json(const Mean& mean)
{
  return {{"mean", mean.value}, {"interval", json(mean.interval)}, {"units", mean.count}};
}

Json json(const SummaryRow& row, const Variation& variation)
{
  const auto& [config, views] = variation;
  const Score& s = row.score;
  Json recalls;
  for (std::size_t i = 0; i < kVisibilityClasses.size(); ++i) {
    const Recall& recall = s.recall[i];
    recalls[kVisibilityClasses[i].key] = {{"affordances", recall.found.whole},
                                          {"found", recall.found.part},
                                          {"recall", recall.found.value()},
                                          {"interval", json(recall.interval)},
                                          {"chance", recall.chance}};
  }
  return {{"scene", row.scene},
          {"group", row.is_group},
          {"preset", config.preset},
          {"estimator", estimatorName(config)},
          {"views", views},
          {"samples", config.sampling.samples},
          {"importance", config.sampling.importance},
          {"frames", s.frames},
          {"runs", s.runs},
          {"right", s.precision.part},
          {"wrong", s.wrong()},
          {"not_counted", s.not_counted},
          {"wrong_per_run", s.wrongPerRun()},
          {"precision", s.precision.value()},
          {"interval", json(s.interval)},
          {"unit_precision", json(s.unit_precision)},
          {"taubin_difference", row.taubin_difference ? json(*row.taubin_difference) : Json()},
          {"recall", recalls},
          {"handles", handleJson(row.handles)}};
}

/// Those of which a table has a column.
std::vector<std::size_t> visibilityColumns(const Evaluation& evaluation)
{
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < kVisibilityClasses.size(); ++i) {
    if (kVisibilityClasses[i].min_elsewhere == 0 || hasSeveralViews(evaluation)) {
      columns.push_back(i);
    }
  }
  return columns;
}

std::string markdownRow(const SummaryRow& row, const std::vector<std::size_t>& visibilities, bool compares)
{
  const Score& s = row.score;
  std::ostringstream line;
  line << "| " << sceneCell(row) << " | " << s.frames << " × " << s.runs << " | " << s.precision.part << " | "
       << s.wrong() << " | " << percent(s.precision.value(), s.interval) << " | "
       << percent(s.unit_precision.value, s.unit_precision.interval) << " | " << text("%.2f", s.wrongPerRun());
  for (const std::size_t visibility : visibilities) {
    const Recall& recall = s.recall[visibility];
    line << " | " << percent(recall.found.value());
    if (recall.found.whole > 0) {
      line << " of " << recall.found.whole;
    }
  }
  line << " | " << percent(s.recall.back().chance);
  if (compares) {
    const Mean difference = row.taubin_difference.value_or(Mean());
    line << " | " << percent(difference.value, difference.interval);
  }
  line << " |\n";
  return line.str();
}

}  // namespace

std::string markdownTables(const Evaluation& evaluation, const std::vector<SummaryRow>& rows)
{
  std::ostringstream tables;
  const std::vector<std::size_t> visibilities = visibilityColumns(evaluation);
  for (std::size_t variation = 0; variation < evaluation.variations.size(); ++variation) {
    bool compares = false;
    for (const SummaryRow& row : rows) {
      compares = compares || (row.variation == variation && row.taubin_difference);
    }
    tables << (variation > 0 ? "\n" : "") << variationTitle(evaluation, variation)
           << ". Precision and recall in percent, with 95 % intervals.\n\n"
           << "| scene | frames × runs | right | wrong | precision | mean precision | wrong per run |";
    for (const std::size_t visibility : visibilities) {
      tables << " recall: " << kVisibilityClasses[visibility].title << " |";
    }
    tables << " chance: " << kVisibilityClasses.back().title << " |" << (compares ? " Taubin minus this |" : "")
           << "\n|---|";
    for (std::size_t i = 0; i < 7 + visibilities.size() + (compares ? 1 : 0); ++i) {
      tables << "---|";
    }
    tables << "\n";
    for (const SummaryRow& row : rows) {
      if (row.variation == variation) {
        tables << markdownRow(row, visibilities, compares);
      }
    }
  }
  tables << "\n" << markdownHandleTables(evaluation, rows);
  if (variesSampling(evaluation)) {
    tables << "\n" << markdownSampleTable(evaluation, rows);
  }
  return tables.str();
}

void writeReport(const std::string& folder, const Evaluation& evaluation, const std::vector<SummaryRow>& rows)
{
  writeShells(folder + "/shells.csv", evaluation);
  writeHandles(folder + "/handles.csv", evaluation);
  writeAffordances(folder + "/affordances.csv", evaluation);
  writeSummary(folder + "/summary.csv", evaluation, rows);
  Json summary = Json::array();
  for (const SummaryRow& row : rows) {
    summary.push_back(json(row, evaluation.variations[row.variation]));
  }
  writeFile(folder + "/summary.json", summary.dump(1) + "\n");
  if (variesSampling(evaluation)) {
    writeSamples(folder + "/samples.csv", evaluation, rows);
  }
  writeFile(folder + "/table.md", markdownTables(evaluation, rows));
}

void writeRuntimes(const std::string& folder, const std::vector<Runtime>& runtimes)
{
  CsvTable table("preset,estimator,samples,k,milliseconds,milliseconds_low,milliseconds_high,calls");
  for (const Runtime& runtime : runtimes) {
    const Config& config = runtime.config;
    const Mean& mean = runtime.milliseconds;
    table.addRow(config.preset, estimatorName(config), config.sampling.samples, config.neighborhood.k, mean.value,
                 mean.interval.low, mean.interval.high, mean.count);
  }
  table.save(folder + "/runtime.csv");
}

}  // namespace grasp_affordances
