#include "core/result/polyline.h"

#include <algorithm>
#include <limits>

namespace grasp_affordances
{
namespace
{

Eigen::Vector3d direction(const Polyline& polyline, std::size_t segment)
{
  return (polyline[segment + 1] - polyline[segment]).normalized();
}

/// Between the segments that meet there.
Eigen::Vector3d tangentAtPoint(const Polyline& polyline, std::size_t i)
{
  const Eigen::Vector3d before = direction(polyline, i > 0 ? i - 1 : 0);
  const Eigen::Vector3d after = direction(polyline, std::min(i, polyline.size() - 2));
  return (before + after).normalized();
}

}  // namespace

PolylinePlace nearestPlace(const Polyline& polyline, const Eigen::Vector3d& point)
{
  PolylinePlace nearest;
  double least = std::numeric_limits<double>::infinity();
  const std::size_t segments = polyline.size() - 1;
  for (std::size_t i = 0; i < segments; ++i) {
    const Eigen::Vector3d along = polyline[i + 1] - polyline[i];
    const double share = (point - polyline[i]).dot(along) / along.squaredNorm();
    const double within = std::clamp(share, 0.0, 1.0);
    const Eigen::Vector3d offset = point - (polyline[i] + within * along);
    if (offset.squaredNorm() < least) {
      least = offset.squaredNorm();
      nearest = {i, within, offset, (i == 0 && share < 0.0) || (i + 1 == segments && share > 1.0)};
    }
  }
  return nearest;
}

Eigen::Vector3d tangentAt(const Polyline& polyline, const PolylinePlace& place)
{
  const Eigen::Vector3d start = tangentAtPoint(polyline, place.segment);
  const Eigen::Vector3d end = tangentAtPoint(polyline, place.segment + 1);
  return ((1.0 - place.share) * start + place.share * end).normalized();
}

double distanceAcross(const Polyline& polyline, const PolylinePlace& place)
{
  if (!place.is_beyond_end) {
    return place.offset.norm();
  }
  const Eigen::Vector3d along = direction(polyline, place.segment);
  return (place.offset - place.offset.dot(along) * along).norm();
}

}  // namespace grasp_affordances
