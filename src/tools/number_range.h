#pragma once

#include <CLI/CLI.hpp>

#include <cmath>
#include <string>

namespace grasp_affordances
{

/// CLI::Range of real numbers, without "nan", which is neither below nor above.
inline CLI::Validator numberRange(double min, double max)
{
  const CLI::Range range(min, max);
  const auto check = [range](std::string& text) {
    double value = 0.0;
    const bool is_nan = CLI::detail::lexical_cast(text, value) && std::isnan(value);
    return is_nan ? text + " is no number" : range(text);
  };
  return CLI::Validator(check, range.get_description());
}

}  // namespace grasp_affordances
