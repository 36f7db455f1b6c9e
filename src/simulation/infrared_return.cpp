#include "simulation/infrared_return.h"

#include <cmath>

namespace grasp_affordances
{
namespace
{

// Each quantity varies over the image, in patches of the size of a matching window. Sources: docs/simulation.md.
constexpr double kPatch = 6.0;  // px

// Cosine of the angle of incidence at which the matching fails: 76 degrees; between 71 and 81 degrees for 95 %.
constexpr double kBreakdown = 0.242;
constexpr double kBreakdownDeviation = 0.042;
constexpr double kSteepestSafe = 0.5;  // 6 standard deviations above

// Depth at which a dark surface, seen at right angles, returns just enough light; and the deviation of that limit.
constexpr double kDarkReach = 1.1;  // m
constexpr double kDarkDeviation = 0.4;

// A mirror that reflects the projector into the camera has a certain normal. A shiny surface is too bright if the angle
// between its normal and that one is less than 10 degrees. This is the sine of that angle.
constexpr double kMirror = 0.17;
constexpr double kMirrorDeviation = 0.3;  // relative to the limit
constexpr double kTooDull = 1.3;          // above, a patch reflects too much light elsewhere: 10 % of the patches

}  // namespace

InfraredReturn::InfraredReturn(std::uint64_t seed, double baseline)
    : projector_(baseline, 0.0, 0.0), patches_(seed, RandomStream::reflection, kPatch)
{
}

bool InfraredReturn::suffices(Surface surface, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                              std::uint32_t column, std::uint32_t row) const
{
  if (surface == Surface::absorbing)
    return false;
  const double cosine = std::abs(normal.dot(point)) / std::sqrt(normal.squaredNorm() * point.squaredNorm());
  if (surface == Surface::diffuse && cosine > kSteepestSafe)
    return true;

  const double patch = patches_(column, row);
  if (cosine < kBreakdown + kBreakdownDeviation * patch)
    return false;
  if (surface == Surface::dark) {
    const double reach = kDarkReach / point.z();
    return cosine * reach * reach > 1.0 + kDarkDeviation * patch;  // Lambert's cosine law and the inverse-square law
  }
  if (surface == Surface::shiny) {
    const Eigen::Vector3d mirror = (projector_ - point).normalized() - point.normalized();
    const double sine = normal.cross(mirror).norm() / std::sqrt(normal.squaredNorm() * mirror.squaredNorm());
    return sine > kMirror * (1.0 + kMirrorDeviation * patch) && patch < kTooDull;
  }
  return true;
}

}  // namespace grasp_affordances
