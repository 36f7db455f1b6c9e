#pragma once

#include "evaluation/statistics.h"
#include "evaluation/summary.h"

#include <cmath>
#include <sstream>
#include <string>

namespace grasp_affordances
{

/// @throw std::runtime_error for a file that cannot be written.
void writeFile(const std::string& path, const std::string& content);

/// Comma-separated values; what is not finite is empty.
class CsvTable
{
public:
  explicit CsvTable(const std::string& header) { text_ << header << "\n"; }

  template <class... Values>
  void add(const Values&... values)
  {
    ((text_ << separator_, cell(values), separator_ = ","), ...);
  }

  void endRow()
  {
    text_ << "\n";
    separator_ = "";
  }

  template <class... Values>
  void addRow(const Values&... values)
  {
    add(values...);
    endRow();
  }

  /// @throw std::runtime_error as writeFile.
  void save(const std::string& path) const { writeFile(path, text_.str()); }

private:
  template <class Value>
  void cell(const Value& value)
  {
    text_ << value;
  }
  void cell(double value)
  {
    if (std::isfinite(value)) {
      text_ << value;
    }
  }

  std::ostringstream text_;
  const char* separator_ = "";
};

const std::string& estimatorName(const Config& config);

/// Of importance sampling.
const char* onOrOff(bool on);

/// Preset, estimator, samples and views of a variation, as the title of a table.
std::string variationTitle(const Evaluation& evaluation, std::size_t variation);

/// A number in the format of printf.
std::string text(const char* format, double value);

/// In percent, or a dash.
std::string percent(double share);
std::string percent(double share, const Interval& interval);

/// The row's first cell in markdown.
std::string sceneCell(const SummaryRow& row);

}  // namespace grasp_affordances
