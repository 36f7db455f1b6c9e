#include "evaluation/suite_store.h"

#include "evaluation/fingerprint.h"
#include "evaluation/report_format.h"
#include "evaluation/suite_cell.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

namespace grasp_affordances
{
namespace
{

using Json = nlohmann::json;

/// The file of labels, and the clouds beside it.
std::vector<std::string> recordedFiles(const std::string& labels)
{
  const std::filesystem::path parent = std::filesystem::absolute(labels).parent_path();
  std::vector<std::string> files{labels};
  for (const auto& entry : std::filesystem::directory_iterator(parent)) {
    if (entry.path().extension() == ".pcd") {
      files.push_back(entry.path().string());
    }
  }
  std::sort(files.begin() + 1, files.end());
  return files;
}

/// For people, with some digits that tell cells of like names apart.
std::string nameOf(const SuiteCell& cell)
{
  const std::string sensor = std::filesystem::path(cell.sensor).stem().string();
  std::string name = cell.row + "-" + sensor + "-" + cell.background + "-" + text("%.4g", 1000.0 * cell.capture_radius);
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '_'; }, '-');
  constexpr std::size_t kDigits = 8;
  return name + "-" + fingerprintOfText(cellDescription(cell).dump()).substr(0, kDigits);
}

}  // namespace

SuiteStore::SuiteStore(std::string folder, const std::string& config_file)
    : folder_(std::move(folder)), code_(fingerprintOfCode())
{
  if (!config_file.empty()) {
    config_ = fingerprintOfFiles({config_file});
  }
  std::filesystem::create_directories(folder_ + "/cells");
}

std::string SuiteStore::picturesOf(const SuiteCell& cell)
{
  return "pictures/" + nameOf(cell);
}

std::string SuiteStore::path(const SuiteCell& cell) const
{
  return folder_ + "/cells/" + nameOf(cell) + ".json";
}

Json SuiteStore::keyOf(const SuiteCell& cell) const
{
  Json key{{"code", code_}, {"config", config_}};
  if (std::filesystem::path(cell.sensor).extension() == ".yaml") {
    key["sensor"] = fingerprintOfFiles({cell.sensor});
  }
  if (cell.recorded()) {
    key["recordings"] = fingerprintOfFiles(recordedFiles(cell.labels));
  }
  return key;
}

std::optional<Json> SuiteStore::find(const SuiteCell& cell) const
{
  std::ifstream file(path(cell));
  const Json stored = Json::parse(file, nullptr, false);  // is_discarded() where it is no JSON or there is none
  if (!stored.is_object() || stored.value("cell", Json()) != cellDescription(cell) ||
      stored.value("key", Json()) != keyOf(cell)) {
    return std::nullopt;
  }
  return stored;
}

Json SuiteStore::save(const SuiteCell& cell, const Json& results, double seconds) const
{
  Json stored{{"cell", cellDescription(cell)},
              {"key", keyOf(cell)},
              {"seconds", seconds},
              {"pictures", picturesOf(cell)},
              {"results", results}};
  const std::string unfinished = path(cell) + ".part";
  writeFile(unfinished, stored.dump(1) + "\n");
  std::filesystem::rename(unfinished, path(cell));
  return stored;
}

}  // namespace grasp_affordances
