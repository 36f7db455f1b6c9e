#include "evaluation/report_format.h"

#include "grasp_affordances/parameters.h"

#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace grasp_affordances
{

void writeFile(const std::string& path, const std::string& content)
{
  std::ofstream file(path, std::ios::binary);
  if (!(file << content) || !file.flush()) {
    throw std::runtime_error(path + ": cannot be written");
  }
}

const std::string& estimatorName(const Config& config)
{
  return enumWord(config.estimation.estimator);
}

const char* onOrOff(bool on)
{
  return on ? "on" : "off";
}

std::string variationTitle(const Evaluation& evaluation, std::size_t variation)
{
  const auto& [config, views] = evaluation.variations[variation];
  std::string title = "Preset `" + config.preset + "`, " + estimatorName(config) + ", " +
                      std::to_string(config.sampling.samples) + " samples";
  if (variesSampling(evaluation)) {
    title += std::string(", importance sampling ") + onOrOff(config.sampling.importance);
  }
  return title + (views > 1 ? ", " + std::to_string(views) + " views" : "");
}

std::string text(const char* format, double value)
{
  char buffer[32];
  std::snprintf(buffer, sizeof(buffer), format, value);
  return buffer;
}

std::string percent(double share)
{
  return std::isfinite(share) ? text("%.1f", 100.0 * share) : "–";
}

std::string percent(double share, const Interval& interval)
{
  const bool known = std::isfinite(share) && std::isfinite(interval.low);
  return percent(share) + (known ? " (" + percent(interval.low) + " to " + percent(interval.high) + ")" : "");
}

std::string sceneCell(const SummaryRow& row)
{
  return row.is_group ? "**all of " + row.scene + "**" : row.scene;
}

}  // namespace grasp_affordances
