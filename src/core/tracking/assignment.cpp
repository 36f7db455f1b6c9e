#include "core/tracking/assignment.h"

#include <limits>

namespace grasp_affordances
{
namespace
{

constexpr Eigen::Index kNone = -1;

/// Shortest augmenting paths. Each row has one column more, of its own, which stands for a row without a column.
class Assignment
{
public:
  Assignment(const Eigen::MatrixXd& costs, double alone)
      : costs_(costs),
        alone_(alone),
        columns_(costs.cols() + costs.rows()),
        row_price_(costs.rows(), 0.0),
        column_price_(columns_, 0.0),
        row_of_(columns_, kNone)
  {
    for (Eigen::Index row = 0; row < costs.rows(); ++row) {
      add(row);
    }
  }

  std::vector<std::optional<Eigen::Index>> columns() const
  {
    std::vector<std::optional<Eigen::Index>> result(costs_.rows());
    for (Eigen::Index column = 0; column < costs_.cols(); ++column) {
      if (row_of_[column] != kNone) {
        result[row_of_[column]] = column;
      }
    }
    return result;
  }

private:
  double cost(Eigen::Index row, Eigen::Index column) const
  {
    if (column < costs_.cols()) {
      return costs_(row, column);
    }
    return column - costs_.cols() == row ? alone_ : std::numeric_limits<double>::infinity();
  }

  /// Gives one more row a column in the cheapest way. Other rows may change their columns. A way always exists, because
  /// the row has a column of its own.
  void add(Eigen::Index row)
  {
    std::vector<double> way(columns_, std::numeric_limits<double>::infinity());
    std::vector<Eigen::Index> column_before(columns_, kNone);
    std::vector<bool> reached(columns_, false);
    Eigen::Index column = kNone;
    double way_here = 0.0;
    while (column == kNone || row_of_[column] != kNone) {
      const Eigen::Index here = column == kNone ? row : row_of_[column];
      Eigen::Index next = kNone;
      for (Eigen::Index candidate = 0; candidate < columns_; ++candidate) {
        if (reached[candidate]) {
          continue;
        }
        const double reduced = way_here + cost(here, candidate) - row_price_[here] - column_price_[candidate];
        if (reduced < way[candidate]) {
          way[candidate] = reduced;
          column_before[candidate] = column;
        }
        if (next == kNone || way[candidate] < way[next]) {
          next = candidate;
        }
      }
      column = next;
      way_here = way[column];
      reached[column] = true;
    }
    for (Eigen::Index i = 0; i < columns_; ++i) {
      if (reached[i] && i != column) {
        column_price_[i] += way[i] - way_here;
        row_price_[row_of_[i]] += way_here - way[i];
      }
    }
    row_price_[row] += way_here;
    while (column_before[column] != kNone) {
      row_of_[column] = row_of_[column_before[column]];
      column = column_before[column];
    }
    row_of_[column] = row;
  }

  const Eigen::MatrixXd& costs_;
  double alone_;
  Eigen::Index columns_;
  std::vector<double> row_price_;
  std::vector<double> column_price_;
  std::vector<Eigen::Index> row_of_;
};

}  // namespace

std::vector<std::optional<Eigen::Index>> cheapestAssignment(const Eigen::MatrixXd& costs, double alone)
{
  return Assignment(costs, alone).columns();
}

}  // namespace grasp_affordances
