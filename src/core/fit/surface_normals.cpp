#include "core/fit/surface_normals.h"

#include <algorithm>

namespace grasp_affordances
{

void SurfaceNormals::reset(std::size_t points)
{
  normals_.reset(points);
  if (required_.size() != points) {
    required_ = std::vector<std::atomic<std::uint8_t>>(points);
  }
  for (auto& required : required_) {
    required.store(kNotRequired, std::memory_order_relaxed);
  }
}

void SurfaceNormals::require(const std::uint32_t* points, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i) {
    std::atomic<std::uint8_t>& required = required_[points[i]];
    if (required.load(std::memory_order_relaxed) == kNotRequired) {
      required.store(kRequired, std::memory_order_relaxed);
    }
  }
}

void SurfaceNormals::listRequired(const Cloud& cloud, std::size_t stride)
{
  points_.clear();
  const std::size_t rows = cloud.organized() ? cloud.height : 1, columns = cloud.size() / rows;
  const std::size_t column_stride = cloud.organized() ? stride : stride * stride;
  for (std::size_t row = 0; row < rows; row += stride) {
    for (std::size_t i = row * columns; i < (row + 1) * columns; i += column_stride) {
      if (required_[i].load(std::memory_order_relaxed) == kRequired) {
        required_[i].store(kDone, std::memory_order_relaxed);
        points_.push_back(static_cast<std::uint32_t>(i));
      }
    }
  }
}

void SurfaceNormals::compute(const Cloud& cloud, const NeighborhoodSearch& search, double radius, std::size_t stride,
                             ThreadTeam& team, const Cancellation& cancellation)
{
  listRequired(cloud, stride);
  neighborhoods_.resize(team.size());
  constexpr std::size_t kBatch = 16;
  team.forEach((points_.size() + kBatch - 1) / kBatch, [&](std::size_t batch, std::size_t member) {
    Neighborhood& neighborhood = neighborhoods_[member];
    for (std::size_t i = batch * kBatch; i < std::min(points_.size(), (batch + 1) * kBatch) && !cancellation.wanted();
         ++i) {
      search.withinRadius(cloud.point(points_[i]), static_cast<float>(radius), neighborhood);
      if (const auto normal = planeNormal(neighborhood)) {
        normals_.set(points_[i], *normal);
      }
    }
  });
  cancellation.check();
}

}  // namespace grasp_affordances
