#pragma once

#include "grasp_affordances/handle.h"
#include "grasp_affordances/localization.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace grasp_affordances
{

/// The axis that some shells share, straight or bent.
struct SharedAxis
{
  Polyline polyline;   ///< m, from end to end: two points where it is straight
  bool round = false;  ///< the shells' axes have no direction in common, as about an apple

  bool straight() const { return polyline.size() == 2; }
};

/// Follows the axis of shells from end to end: shells that nearly coincide are one node, the nodes are joined to a tree
/// of least total length, and its longest path is the axis, also of a ring. It is straight where nearly all shells are
/// near the line through their middles. Keeps its memory.
class AxisTracer
{
public:
  /// @param shells  of one handle, at least one
  void trace(const std::vector<const Shell*>& shells, SharedAxis& axis);

private:
  /// Shells that are so near to one another that they are one point of the axis. Sums over them.
  struct Node
  {
    double shells = 0.0;
    Eigen::Vector3d places = Eigen::Vector3d::Zero();
    Eigen::Vector3d directions = Eigen::Vector3d::Zero();  // with those of opposite sign turned
    double half_lengths = 0.0;

    Eigen::Vector3d place() const { return places / shells; }
    Eigen::Vector3d direction() const { return directions.normalized(); }
    void add(const Shell& shell);
  };

  bool traceLine(const std::vector<const Shell*>& shells, SharedAxis& axis);
  void makeNodes(const std::vector<const Shell*>& shells);
  void joinNodes();
  std::size_t farthestFrom(std::size_t start);
  void followPath(SharedAxis& axis);

  std::vector<Node> nodes_;
  std::vector<std::size_t> parents_;                  // of the tree: nodes that were joined before
  std::vector<std::vector<std::size_t>> neighbours_;  // in the tree
  std::vector<double> distances_;
  std::vector<std::size_t> before_, path_, open_;
  std::vector<double> ends_;
};

}  // namespace grasp_affordances
