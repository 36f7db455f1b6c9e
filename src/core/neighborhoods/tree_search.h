#pragma once

#include "core/neighborhoods/neighborhoods.h"
#include "core/parallel/thread_team.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// Searches any cloud in a k-d tree: a balanced one, whose nodes know the box of their points. The points are stored in
/// the order of the leaves, so that a sphere's points are neighbors in memory, whatever their order in the cloud. Keeps
/// its memory from cloud to cloud.
class TreeSearch : public NeighborhoodSearch
{
public:
  /// Searches another cloud. The cloud must stay as it is for as long as it is searched.
  /// @param team  does the work, without influence on any result; null: the caller's thread does it
  void update(const Cloud& cloud, ThreadTeam* team = nullptr);

  void withinRadius(const Eigen::Vector3f& center, float radius, Neighborhood& result) const override;
  void nearest(const Eigen::Vector3f& center, std::size_t k, Neighborhood& result) const override;

private:
  struct Point
  {
    float at[3];
    std::uint32_t index;  // in the cloud
  };

  struct Box
  {
    float low[3], high[3];

    double squaredDistance(const Eigen::Vector3f& place) const;          // m^2, to the nearest of its places
    double squaredFarthestDistance(const Eigen::Vector3f& place) const;  // m^2, to the farthest of its places
  };

  /// The nodes of a level halve those of the level above, and are numbered from 0.
  struct Node
  {
    std::size_t level, number;
  };

  /// Points [begin, end), in the order of the leaves.
  struct Range
  {
    std::size_t begin, end;
  };

  Range rangeOf(const Node& node) const;
  Box& boxOf(const Node& node) { return boxes_[(std::size_t{1} << node.level) - 1 + node.number]; }
  const Box& boxOf(const Node& node) const { return boxes_[(std::size_t{1} << node.level) - 1 + node.number]; }
  void listPoints(const Cloud& cloud, ThreadTeam* team);
  void split(const Node& node);
  void splitAll(const Node& node);
  void storePoints(ThreadTeam* team);
  std::size_t findRanges(const Eigen::Vector3f& center, float radius, std::vector<Range>& ranges) const;

  const Cloud* cloud_ = nullptr;
  std::size_t levels_ = 0;            // below the root; the nodes of the last one are the leaves
  std::vector<Box> boxes_;            // level by level
  std::vector<Point> points_;         // in the order of the leaves; used while the tree is made
  Cloud leaves_;                      // the same points as coordinate arrays
  std::vector<std::uint32_t> index_;  // of these points in the cloud
};

}  // namespace grasp_affordances
