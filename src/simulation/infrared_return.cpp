#include "simulation/infrared_return.h"

#include <cmath>

namespace grasp_affordances
{
namespace
{

// Each quantity varies over the image, in patches of the size of a matching window. Sources: docs/simulation.md.
constexpr double kPatch = 6.0;  // px

// Standard deviations of the cosine of incidence at which the matching fails (of an Xtion 76 degrees; between 71 and 81
// degrees for 95 %), and of the reach of dark surfaces.
constexpr double kBreakdownDeviation = 0.042;
constexpr double kLargestDeviate = 6.0;  // of PatchNoise
constexpr double kDarkDeviation = 0.4;

// A mirror that reflects the projector into the camera has a certain normal. A shiny surface is too bright if the angle
// between its normal and that one is less than 10 degrees. This is the sine of that angle.
constexpr double kMirror = 0.17;
constexpr double kMirrorDeviation = 0.3;  // relative to the limit

}  // namespace

InfraredReturn::InfraredReturn(const SensorModel& model, std::uint64_t seed)
    : breakdown_(model.grazing_cosine),
      dark_reach_(model.dark_reach),
      too_dull_(exceededBy(model.shiny_loss)),
      projector_(model.projector_x, 0.0, 0.0),
      patches_(seed, RandomStream::reflection, kPatch)
{
}

bool InfraredReturn::suffices(Surface surface, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                              std::uint32_t column, std::uint32_t row) const
{
  if (surface == Surface::absorbing)
    return false;
  const double cosine = std::abs(normal.dot(point)) / std::sqrt(normal.squaredNorm() * point.squaredNorm());
  if (surface == Surface::diffuse && cosine > breakdown_ + kLargestDeviate * kBreakdownDeviation)
    return true;

  const double patch = patches_(column, row);
  if (cosine < breakdown_ + kBreakdownDeviation * patch)
    return false;
  if (surface == Surface::dark) {
    const double reach = dark_reach_ / point.z();
    return cosine * reach * reach > 1.0 + kDarkDeviation * patch;  // Lambert's cosine law and the inverse-square law
  }
  if (surface == Surface::shiny) {
    const Eigen::Vector3d mirror = (projector_ - point).normalized() - point.normalized();
    const double sine = normal.cross(mirror).norm() / std::sqrt(normal.squaredNorm() * mirror.squaredNorm());
    return sine > kMirror * (1.0 + kMirrorDeviation * patch) && patch < too_dull_;
  }
  return true;
}

}  // namespace grasp_affordances
