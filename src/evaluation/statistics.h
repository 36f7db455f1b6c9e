#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace grasp_affordances
{

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

/// A share, counted.
struct Ratio
{
  std::size_t part = 0;
  std::size_t whole = 0;

  double value() const  ///< in [0, 1]; NaN for a share of nothing
  {
    return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : kUndefined;
  }
  Ratio& operator+=(const Ratio& other)
  {
    part += other.part;
    whole += other.whole;
    return *this;
  }
};

/// Confidence interval of 95 %; NaN where it is not known.
struct Interval
{
  double low = kUndefined;
  double high = kUndefined;
};

struct Mean
{
  double value = kUndefined;
  Interval interval;
  std::size_t count = 0;  ///< of the values
};

/// Mean of independent values, with the interval of Student's t distribution; none from fewer than two values.
Mean mean(const std::vector<double>& values);

/// Mean of the shares that are defined, likewise; the interval is cut off at 0 and 1.
Mean meanShare(const std::vector<Ratio>& units);

/// All parts over all wholes.
Ratio pooled(const std::vector<Ratio>& units);

/// Interval of the pooled share by the percentile bootstrap (Efron and Tibshirani, "An Introduction to the Bootstrap",
/// chapter 13): 2000 times as many units are drawn with replacement, from a fixed seed. What is within one unit may
/// depend on one another, as shells of one frame do. None from fewer than two units.
Interval pooledInterval(const std::vector<Ratio>& units);

/// The value that a share, in [0, 1], of the values is below, interpolated between neighbors; NaN for no values.
double quantile(std::vector<double> values, double share);

/// Mean of a - b over the units in which both shares are defined.
Mean pairedDifference(const std::vector<Ratio>& a, const std::vector<Ratio>& b);

}  // namespace grasp_affordances
