#include "core/tracking/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <random>
#include <set>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

/// The cheapest of all assignments.
double cheapest(const Eigen::MatrixXd& costs, double alone, Eigen::Index row, std::vector<bool>& taken)
{
  if (row == costs.rows()) {
    return 0.0;
  }
  double best = alone + cheapest(costs, alone, row + 1, taken);
  for (Eigen::Index column = 0; column < costs.cols(); ++column) {
    if (!taken[column]) {
      taken[column] = true;
      best = std::min(best, costs(row, column) + cheapest(costs, alone, row + 1, taken));
      taken[column] = false;
    }
  }
  return best;
}

TEST(CheapestAssignment, IsAsCheapAsTheBestOfAll)
{
  std::mt19937 generator(29);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Index rows = i % 6, columns = i / 6 % 6;
    Eigen::MatrixXd costs(rows, columns);
    for (Eigen::Index k = 0; k < costs.size(); ++k) {
      const double cost = uniform(generator);
      // Of few values, so that several assignments cost the same.
      costs(k) = cost > 0.8 ? std::numeric_limits<double>::infinity() : std::floor(8.0 * cost) / 4.0;
    }
    double sum = 0.0;
    std::set<Eigen::Index> used;
    const std::vector<std::optional<Eigen::Index>> assigned = cheapestAssignment(costs, 1.0);
    ASSERT_EQ(assigned.size(), static_cast<std::size_t>(rows));
    for (Eigen::Index row = 0; row < rows; ++row) {
      sum += assigned[row] ? costs(row, *assigned[row]) : 1.0;
      EXPECT_TRUE(!assigned[row] || used.insert(*assigned[row]).second);
    }
    std::vector<bool> taken(columns, false);
    EXPECT_NEAR(sum, cheapest(costs, 1.0, 0, taken), 1e-12) << costs;
  }
}

}  // namespace
}  // namespace grasp_affordances::test
