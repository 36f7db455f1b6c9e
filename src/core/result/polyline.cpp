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

/// Where a point is beside a segment: 0 at the segment's start, 1 at its end.
double shareBeside(const Eigen::Vector3d& offset, const Eigen::Vector3d& segment)
{
  return offset.dot(segment) / segment.squaredNorm();
}

}  // namespace

double lengthOf(const Polyline& polyline)
{
  double length = 0.0;
  for (std::size_t i = 1; i < polyline.size(); ++i) {
    length += (polyline[i] - polyline[i - 1]).norm();
  }
  return length;
}

PolylineDistance placeAtDistance(const Polyline& polyline, double distance)
{
  PolylineDistance place{0, distance, 0.0};
  for (std::size_t i = 1; i < polyline.size(); ++i) {
    place.segment = i - 1;
    place.segment_length = (polyline[i] - polyline[i - 1]).norm();
    const bool reached = place.from_start <= place.segment_length && place.segment_length > 0.0;
    if (reached || i + 1 == polyline.size()) {
      break;
    }
    place.from_start -= place.segment_length;
  }
  return place;
}

Eigen::Vector3d pointAt(const Polyline& polyline, double distance)
{
  const PolylineDistance place = placeAtDistance(polyline, distance);
  if (!(place.from_start <= place.segment_length && place.segment_length > 0.0)) {
    return polyline.back();
  }
  const double share = std::max(0.0, place.from_start / place.segment_length);
  return polyline[place.segment] + share * (polyline[place.segment + 1] - polyline[place.segment]);
}

/// The point is not that of pointAt() to the last bit: it is rounded as the centroids of handles always were.
PolylineMiddle middleOf(const Polyline& polyline)
{
  const PolylineDistance place = placeAtDistance(polyline, lengthOf(polyline) / 2);
  const Eigen::Vector3d step = polyline[place.segment + 1] - polyline[place.segment];
  PolylineMiddle middle;
  middle.direction =
      place.segment_length > 0.0 ? Eigen::Vector3d(step / place.segment_length) : Eigen::Vector3d::UnitZ();
  middle.point = polyline[place.segment] + place.from_start * middle.direction;
  return middle;
}

Eigen::Vector3d chordAround(const Polyline& polyline, std::size_t i)
{
  return polyline[std::min(i + 1, polyline.size() - 1)] - polyline[i > 0 ? i - 1 : 0];
}

PolylinePlace nearestPlace(const Polyline& polyline, const Eigen::Vector3d& point)
{
  PolylinePlace nearest;
  double least = std::numeric_limits<double>::infinity();
  const std::size_t segments = polyline.size() - 1;
  for (std::size_t i = 0; i < segments; ++i) {
    const Eigen::Vector3d along = polyline[i + 1] - polyline[i];
    const double share = shareBeside(point - polyline[i], along);
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

double distanceBeside(const Polyline& polyline, const Eigen::Vector3d& point)
{
  double least = std::numeric_limits<double>::infinity();
  const std::size_t segments = polyline.size() - 1;
  for (std::size_t i = 0; i < segments; ++i) {
    const Eigen::Vector3d along = polyline[i + 1] - polyline[i], offset = point - polyline[i];
    const double share = shareBeside(offset, along);
    if ((share >= 0.0 || i > 0) && (share <= 1.0 || i + 1 < segments)) {
      least = std::min(least, (offset - std::clamp(share, 0.0, 1.0) * along).norm());
    }
  }
  return least;
}

}  // namespace grasp_affordances
