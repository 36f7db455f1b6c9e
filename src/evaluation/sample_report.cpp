#include "evaluation/sample_report.h"

#include "evaluation/report_format.h"

#include <algorithm>
#include <array>
#include <sstream>

namespace grasp_affordances
{
namespace
{

/// Indices of the classes that the table has columns for.
constexpr std::array<std::size_t, 3> kClasses{0, 2, 4};

}  // namespace

std::string markdownSampleTable(const Evaluation& evaluation, const std::vector<SummaryRow>& rows)
{
  std::ostringstream table;
  table << "Recall over the number of samples, in percent.\n\n"
        << "| scene | preset | estimator | views | samples | importance sampling |";
  for (const char* what : {"shells", "at least one handle", "exactly one handle"}) {
    for (const std::size_t i : kClasses) {
      table << " " << what << ": " << kVisibilityClasses[i].title << " |";
    }
  }
  table << " shell precision | handle precision |\n|---|";
  for (std::size_t column = 0; column < 7 + 3 * kClasses.size(); ++column) {
    table << "---|";
  }
  table << "\n";
  const bool has_groups = std::any_of(rows.begin(), rows.end(), [](const SummaryRow& row) { return row.is_group; });
  for (const SummaryRow& row : rows) {
    if (row.is_group != has_groups) {
      continue;
    }
    const auto& [config, views] = evaluation.variations[row.variation];
    table << "| " << sceneCell(row) << " | " << config.preset << " | " << estimatorName(config) << " | " << views
          << " | " << config.sampling.samples << " | " << onOrOff(config.sampling.importance) << " |";
    for (const std::size_t i : kClasses) {
      table << " " << percent(row.score.recall[i].found.value()) << " |";
    }
    for (const std::size_t i : kClasses) {
      table << " " << percent(row.handles.affordances[i].found().value()) << " |";
    }
    for (const std::size_t i : kClasses) {
      table << " " << percent(row.handles.affordances[i].exactlyOne().value()) << " |";
    }
    table << " " << percent(row.score.precision.value()) << " | " << percent(row.handles.precision.value()) << " |\n";
  }
  return table.str();
}

void writeSamples(const std::string& path, const Evaluation& evaluation, const std::vector<SummaryRow>& rows)
{
  std::string header = "scene,group,preset,estimator,views,samples,importance,precision,handle_precision";
  for (const VisibilityClass& visibility : kVisibilityClasses) {
    const std::string key = visibility.key;
    header += ",affordances_" + key + ",recall_" + key + ",handle_recall_" + key + ",exactly_one_" + key;
  }
  CsvTable table(header);
  for (const SummaryRow& row : rows) {
    const auto& [config, views] = evaluation.variations[row.variation];
    table.add(row.scene, row.is_group ? 1 : 0, config.preset, estimatorName(config), views, config.sampling.samples,
              onOrOff(config.sampling.importance), row.score.precision.value(), row.handles.precision.value());
    for (std::size_t i = 0; i < kVisibilityClasses.size(); ++i) {
      const HandlesPerAffordance& counts = row.handles.affordances[i];
      table.add(counts.affordances(), row.score.recall[i].found.value(), counts.found().value(),
                counts.exactlyOne().value());
    }
    table.endRow();
  }
  table.save(path);
}

}  // namespace grasp_affordances
