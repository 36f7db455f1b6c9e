#include "evaluation/statistics.h"

#include "core/parallel/random.h"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace grasp_affordances
{
namespace
{

constexpr double kTail = 0.025;  // beyond either end of an interval of 95 %

}  // namespace

Mean mean(const std::vector<double>& values)
{
  Mean result;
  result.count = values.size();
  if (values.empty()) {
    return result;
  }
  const auto n = static_cast<double>(values.size());
  result.value = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (values.size() < 2) {
    return result;
  }
  double squares = 0.0;
  for (const double value : values) {
    squares += (value - result.value) * (value - result.value);
  }
  const double t = boost::math::quantile(boost::math::students_t(n - 1.0), 1.0 - kTail);
  const double half = t * std::sqrt(squares / (n - 1.0) / n);
  result.interval = {result.value - half, result.value + half};
  return result;
}

Mean meanShare(const std::vector<Ratio>& units)
{
  std::vector<double> values;
  for (const Ratio& unit : units) {
    if (unit.whole > 0) {
      values.push_back(unit.value());
    }
  }
  Mean result = mean(values);
  if (values.size() >= 2) {
    result.interval = {std::max(0.0, result.interval.low), std::min(1.0, result.interval.high)};
  }
  return result;
}

Ratio pooled(const std::vector<Ratio>& units)
{
  Ratio sum;
  for (const Ratio& unit : units) {
    sum += unit;
  }
  return sum;
}

Interval pooledInterval(const std::vector<Ratio>& units)
{
  constexpr std::size_t kResamples = 2000;
  constexpr std::uint64_t kSeed = 1;
  if (units.size() < 2) {
    return {};
  }
  std::vector<double> values;
  values.reserve(kResamples);
  std::uint64_t draw = 0;
  for (std::size_t resample = 0; resample < kResamples; ++resample) {
    Ratio sum;
    for (std::size_t i = 0; i < units.size(); ++i) {
      sum += units[randomIndex(randomBits(kSeed, draw++), static_cast<std::uint32_t>(units.size()))];
    }
    if (sum.whole > 0) {
      values.push_back(sum.value());
    }
  }
  if (values.empty()) {
    return {};
  }
  std::sort(values.begin(), values.end());
  const auto quantile = [&](double share) {
    return values[static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
  };
  return {quantile(kTail), quantile(1.0 - kTail)};
}

double quantile(std::vector<double> values, double share)
{
  if (values.empty()) {
    return kUndefined;
  }
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

Mean pairedDifference(const std::vector<Ratio>& a, const std::vector<Ratio>& b)
{
  std::vector<double> differences;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (a[i].whole > 0 && b[i].whole > 0) {
      differences.push_back(a[i].value() - b[i].value());
    }
  }
  return mean(differences);
}

}  // namespace grasp_affordances
