#pragma once

#include "grasp_affordances/cloud.h"

#include "core/fit/normals.h"
#include "core/neighborhoods/neighborhoods.h"
#include "core/parallel/cancellation.h"
#include "core/parallel/thread_team.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// Surface normals of those points of a cloud that the Normals variation asks for. Each is computed once. Keeps its
/// memory from cloud to cloud.
class SurfaceNormals
{
public:
  /// A stride for compute() with which a sixteenth of the normals is computed.
  static constexpr std::size_t kSparseStride = 4;

  /// Starts over, without normals, for another cloud. @param points  number of its points
  void reset(std::size_t points);

  /// Asks for the normals of points, by their indices. Safe to call from many threads.
  void require(const std::uint32_t* points, std::size_t count);

  /// Computes the normals that were asked for since the last call: of the plane that fits the points within `radius`
  /// (m) of each point.
  /// @param stride  1: for all points that were asked for; otherwise only for those of every stride-th row and column,
  /// or for every stride^2-th point where the cloud is not organized
  /// @throw Cancelled
  void compute(const Cloud& cloud, const NeighborhoodSearch& search, double radius, std::size_t stride,
               ThreadTeam& team, const Cancellation& cancellation = Cancellation());

  /// NaN for points that have none.
  const Normals& normals() const { return normals_; }

private:
  static constexpr std::uint8_t kNotRequired = 0, kRequired = 1, kDone = 2;

  void listRequired(const Cloud& cloud, std::size_t stride);

  std::vector<std::atomic<std::uint8_t>> required_;  // per point
  std::vector<std::uint32_t> points_;                // that get a normal
  std::vector<Neighborhood> neighborhoods_;          // per member of the team
  Normals normals_;
};

}  // namespace grasp_affordances
