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

/// Surface normals of those points of a cloud that the Normals variation asks for, each computed once. Keeps its memory
/// from cloud to cloud.
class SurfaceNormals
{
public:
  /// For compute(), where a sixteenth of the normals is enough.
  static constexpr std::size_t kSparseStride = 4;

  /// Starts over, with no normals, for a cloud of so many points.
  void reset(std::size_t points);

  /// Asks for the normals of points, by their indices. Safe to call from many threads.
  void require(const std::uint32_t* points, std::size_t count);

  /// Computes what was asked for since it was last called: the planes that fit the points within `radius` (m) of each
  /// point.
  /// @param stride 1 for all points that were asked for; otherwise those of every stride-th row and column, where the
  /// cloud is not organized of every stride^2-th point.
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
