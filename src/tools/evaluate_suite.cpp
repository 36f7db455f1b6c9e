#include "tools/evaluate_suite.h"

#include "evaluation/report_format.h"
#include "evaluation/suite_cell.h"
#include "evaluation/suite_store.h"
#include "evaluation/suite_table.h"
#include "tools/progress.h"

#include <chrono>
#include <cmath>
#include <iostream>
#include <optional>

namespace grasp_affordances
{
namespace
{

using Json = nlohmann::json;

std::string titleOf(const SuiteCell& cell)
{
  return cell.row + ", " + cell.sensor + ", " + cell.background + ", " + text("%.4g", 100.0 * cell.capture_radius) +
         " cm";
}

Json finished(const SuiteStore& store, const SuiteCell& cell, const SuiteOptions& options)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  Progress progress(titleOf(cell), framesOf(cell).size());
  const Json results = evaluateCell(cell, options.config_file, options.out + "/" + SuiteStore::picturesOf(cell),
                                    options.threads, [&] { progress.step(); });
  return store.save(cell, results, std::round(std::chrono::duration<double>(Clock::now() - start).count()));
}

}  // namespace

void evaluateSuite(const SuiteOptions& options)
{
  const SuiteStore store(options.out, options.config_file);
  std::vector<SuiteCell> asked = options.cells;
  for (const SuiteCell& cell : recordedCells(options.labels, options.sensor, options.cells.front())) {
    asked.push_back(cell);
  }
  std::vector<Json> cells;
  for (const SuiteCell& cell : asked) {
    const std::optional<Json> stored = store.find(cell);
    cells.push_back(stored ? *stored : finished(store, cell, options));
  }
  writeFile(options.out + "/suite.json", Json{{"suite", options.name}, {"cells", cells}}.dump() + "\n");
  const std::string tables = suiteTables(cells);
  writeFile(options.out + "/table.md", tables);
  std::cout << tables;
}

}  // namespace grasp_affordances
