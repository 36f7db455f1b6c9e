#include "evaluation/suite_table.h"

#include "evaluation/report_format.h"
#include "grasp_affordances/localization.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <sstream>
#include <utility>

namespace grasp_affordances
{
namespace
{

using Json = nlohmann::json;

/// A cell's result of one preset.
struct Entry
{
  std::string row, column;
  const Json& cell;  ///< its description
  const Json& result;
};

using Entries = std::vector<Entry>;
using CellText = std::function<std::string(const Entry& entry)>;

std::string columnOf(const Json& cell)
{
  return cell.at("sensor").get<std::string>() + ", " + cell.at("background").get<std::string>();
}

/// Each once, in the order of the entries.
std::vector<std::string> distinct(const Entries& entries, std::string Entry::*member)
{
  std::vector<std::string> values;
  for (const Entry& entry : entries) {
    if (std::find(values.begin(), values.end(), entry.*member) == values.end()) {
      values.push_back(entry.*member);
    }
  }
  return values;
}

std::string shareText(const Json& share)
{
  return share.is_null() ? "–" : text("%.1f", 100.0 * share.get<double>());
}

std::string handlesText(const Entry& entry)
{
  const Json& handles = entry.result.at("handles");
  std::ostringstream cell;
  const auto affordances = handles.at("affordances").get<std::size_t>();
  if (affordances > 0) {
    const auto percentOf = [&](const char* key) {
      return text("%.1f", 100.0 * handles.at(key).get<double>() / static_cast<double>(affordances));
    };
    cell << "**" << percentOf("one") << "** of " << affordances << ", " << percentOf("none") << ", "
         << percentOf("several") << "; ";
  }
  cell << handles.at("wrong").get<std::size_t>() << ", " << shareText(handles.at("precision"));
  return cell.str();
}

std::string shellsText(const Entry& entry)
{
  const Json& shells = entry.result.at("shells");
  return shareText(shells.at("recall")) + ", " + shareText(shells.at("precision"));
}

/// Rows by columns.
std::string grid(const Entries& entries, const CellText& cellText)
{
  const std::vector<std::string> columns = distinct(entries, &Entry::column);
  std::ostringstream table;
  table << "| |";
  for (const std::string& column : columns) {
    table << " " << column << " |";
  }
  table << "\n|---|";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    table << "---|";
  }
  table << "\n";
  for (const std::string& row : distinct(entries, &Entry::row)) {
    table << "| `" << row << "` |";
    for (const std::string& column : columns) {
      const auto entry = std::find_if(entries.begin(), entries.end(), [&](const Entry& candidate) {
        return candidate.row == row && candidate.column == column;
      });
      table << (entry == entries.end() ? "" : " " + cellText(*entry)) << " |";
    }
    table << "\n";
  }
  return table.str();
}

/// Outcomes that some sample on a missed affordance had, in the order of Outcome.
std::vector<std::string> outcomesIn(const Entries& entries)
{
  std::vector<std::string> names;
  for (std::size_t i = 0; i < kOutcomes; ++i) {
    const std::string name = outcomeName(static_cast<Outcome>(i));
    if (std::any_of(entries.begin(), entries.end(),
                    [&](const Entry& entry) { return entry.result.at("missed").at("ends").contains(name); })) {
      names.push_back(name);
    }
  }
  return names;
}

std::string missedTable(const Entries& entries)
{
  const std::vector<std::string> outcomes = outcomesIn(entries);
  std::ostringstream table;
  table << "| | | missed | samples on them |";
  for (const std::string& outcome : outcomes) {
    table << " " << outcome << " |";
  }
  table << "\n|---|---|---|---|";
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    table << "---|";
  }
  table << "\n";
  for (const Entry& entry : entries) {
    const Json& missed = entry.result.at("missed");
    std::uint64_t samples = 0;
    for (const Json& count : missed.at("ends")) {
      samples += count.get<std::uint64_t>();
    }
    if (missed.at("affordances").get<std::size_t>() == 0) {
      continue;
    }
    table << "| `" << entry.row << "` | " << entry.column << " | " << missed.at("affordances").get<std::size_t>()
          << " | " << samples << " |";
    for (const std::string& outcome : outcomes) {
      const auto count = missed.at("ends").value(outcome, std::uint64_t{0});
      table << " "
            << (samples > 0 ? text("%.0f", 100.0 * static_cast<double>(count) / static_cast<double>(samples)) : "–")
            << " |";
    }
    table << "\n";
  }
  return table.str();
}

std::size_t handlesIn(const Json& bin)
{
  return bin.at("right").get<std::size_t>() + bin.at("wrong").get<std::size_t>();
}

/// Numbers of the bins of scores in which there is a handle.
std::vector<std::size_t> binsIn(const Entries& entries)
{
  std::vector<std::size_t> bins;
  for (std::size_t i = 0; i < entries.front().result.at("reliability").size(); ++i) {
    if (std::any_of(entries.begin(), entries.end(),
                    [&](const Entry& entry) { return handlesIn(entry.result.at("reliability").at(i)) > 0; })) {
      bins.push_back(i);
    }
  }
  return bins;
}

std::string reliabilityTable(const Entries& entries)
{
  const std::vector<std::size_t> bins = binsIn(entries);
  std::ostringstream table;
  table << "| | |";
  for (const std::size_t i : bins) {
    const Json& bin = entries.front().result.at("reliability").at(i);
    table << " " << text("%.1f", bin.at("from").get<double>()) << " to " << text("%.1f", bin.at("to").get<double>())
          << " |";
  }
  table << "\n|---|---|";
  for (std::size_t i = 0; i < bins.size(); ++i) {
    table << "---|";
  }
  table << "\n";
  for (const Entry& entry : entries) {
    table << "| `" << entry.row << "` | " << entry.column << " |";
    for (const std::size_t i : bins) {
      const Json& bin = entry.result.at("reliability").at(i);
      const double right = bin.at("right").get<double>();
      if (handlesIn(bin) > 0) {
        table << " " << text("%.1f", 100.0 * right / static_cast<double>(handlesIn(bin))) << " of " << handlesIn(bin);
      }
      table << " |";
    }
    table << "\n";
  }
  return table.str();
}

/// Scenes, seeds and runs.
std::string coverageText(const Entry& entry)
{
  const Json& seeds = entry.cell.at("seeds");
  const auto runs = entry.result.at("runs").get<std::size_t>();
  std::string cell = std::to_string(entry.result.at("scenes").size());
  if (!seeds.empty()) {
    const auto first = seeds.front().get<std::uint64_t>(), last = seeds.back().get<std::uint64_t>();
    cell += " × " + (last - first + 1 == seeds.size() ? std::to_string(first) + " to " + std::to_string(last)
                                                      : std::to_string(seeds.size()) + " seeds");
  }
  return cell + (runs == 1 ? "" : " × " + std::to_string(runs) + " runs");
}

std::string tablesOf(const Entries& entries, const std::string& title)
{
  std::ostringstream tables;
  tables << "## " << title << "\n\nHandles: affordances with **exactly one** right handle, of those that show at least "
         << "200 points; with none; with several; wrong handles, and precision. All but numbers in percent.\n\n"
         << grid(entries, handlesText) << "\nShells: recall of the same affordances, precision.\n\n"
         << grid(entries, shellsText) << "\nWhere the samples ended on affordances that no right handle finds, in "
         << "percent of these samples.\n\n"
         << missedTable(entries) << "\nHandles that are right, in percent, by their score.\n\n"
         << reliabilityTable(entries) << "\nScenes × seeds of each cell.\n\n"
         << grid(entries, coverageText);
  return tables.str();
}

/// What the cells have of one preset and capture radius.
Entries entriesOf(const std::vector<Json>& cells, const std::string& preset, double capture_radius)
{
  Entries entries;
  for (const Json& cell : cells) {
    const Json& description = cell.at("cell");
    for (const Json& result : cell.at("results")) {
      if (result.at("preset") == preset && description.at("capture_radius") == capture_radius) {
        entries.push_back({description.at("row").get<std::string>(), columnOf(description), description, result});
      }
    }
  }
  return entries;
}

}  // namespace

std::string suiteTables(const std::vector<Json>& cells)
{
  std::set<std::pair<std::string, double>> known;
  std::ostringstream tables;
  for (const Json& cell : cells) {
    const auto capture_radius = cell.at("cell").at("capture_radius").get<double>();
    for (const Json& result : cell.at("results")) {
      const auto preset = result.at("preset").get<std::string>();
      if (known.insert({preset, capture_radius}).second) {
        const std::string title = "Preset `" + preset + "`, capture radius " + text("%.4g", 100.0 * capture_radius) +
                                  " cm, " + std::to_string(result.at("samples").get<int>()) + " samples";
        tables << (known.size() > 1 ? "\n" : "") << tablesOf(entriesOf(cells, preset, capture_radius), title);
      }
    }
  }
  return tables.str();
}

}  // namespace grasp_affordances
