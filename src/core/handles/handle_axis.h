#pragma once

#include "grasp_affordances/handle.h"
#include "grasp_affordances/localization.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace grasp_affordances
{

/// The common axis of some shells, straight or bent.
struct SharedAxis
{
  Polyline polyline;   ///< from end to end; two points where it is straight
  bool round = false;  ///< the shells' axes have no common direction, as about an apple

  bool straight() const { return polyline.size() == 2; }
};

/// Traces the axis of shells from end to end. The axis is straight where nearly all shells are near the line through
/// their middles. Otherwise shells that nearly coincide become one node, the nodes are joined to a tree of least total
/// length, and the longest path in the tree is the axis. The axis of a ring is thus open at some place.
///
/// Keeps its memory.
class AxisTracer
{
public:
  /// @param shells  of one handle, at least one
  void trace(const std::vector<const Shell*>& shells, SharedAxis& axis);

private:
  /// Shells so near to one another that they are one point of the axis: sums over these shells.
  struct Node
  {
    double shells = 0.0;
    Eigen::Vector3d places = Eigen::Vector3d::Zero();
    Eigen::Vector3d directions = Eigen::Vector3d::Zero();  // each turned into the half-space of the others
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
  std::vector<std::size_t> parents_;                  // in the tree: the node that each was joined to
  std::vector<std::vector<std::size_t>> neighbours_;  // in the tree
  std::vector<double> distances_;
  std::vector<std::size_t> before_, path_, open_;
  std::vector<double> ends_;
};

}  // namespace grasp_affordances
