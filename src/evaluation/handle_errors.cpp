#include "evaluation/handle_errors.h"

#include "core/result/polyline.h"

#include <cmath>

namespace grasp_affordances
{
namespace
{

/// In [0, pi/2].
double angleBetweenLines(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

HandleErrors errorsOnBall(const GraspHandle& handle, const Eigen::Vector3d& center, double radius)
{
  HandleErrors errors;
  errors.center = (center - handle.centroid).cross(handle.axis).norm();
  errors.radius = handle.radius - radius;
  return errors;
}

}  // namespace

HandleErrors handleErrors(const GraspHandle& handle, const Affordance& affordance)
{
  if (affordance.ball_center) {
    return errorsOnBall(handle, *affordance.ball_center, affordance.radius);
  }
  if (affordance.axis.size() < 2) {
    return {};
  }
  const PolylinePlace place = nearestPlace(affordance.axis, handle.centroid);
  const double radius_there =
      (1.0 - place.share) * affordance.radii[place.segment] + place.share * affordance.radii[place.segment + 1];
  HandleErrors errors;
  errors.center = distanceAcross(affordance.axis, place);
  errors.axis = angleBetweenLines(handle.axis, tangentAt(affordance.axis, place));
  errors.radius = handle.radius - radius_there;
  return errors;
}

}  // namespace grasp_affordances
