#include "core/kernels/pixel_lookup.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/pixel_lookup.cpp"
#include "core/kernels/simd.h"
#include "core/kernels/simd_real.h"

HWY_BEFORE_NAMESPACE();
namespace grasp_affordances
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;
static_assert(kLookupGroup == kRealLanes, "groups of points fill lanes of double precision");

HWY_ATTR HWY_INLINE Real nearestPixel(double focal_length, Real lateral, Real depth, double principal_point)
{
  return hn::Floor((Real(focal_length) * lateral / depth + Real(principal_point) + Real(0.5)).lanes);
}

HWY_ATTR void lookUpPixels(const PinholeImage& image, const double* const points[3], std::size_t count, double* pixels)
{
  const Real::D d;
  const Real none(-1.0), width(image.width), height(image.height);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const Real x = hn::LoadU(d, points[0] + i), y = hn::LoadU(d, points[1] + i), z = hn::LoadU(d, points[2] + i);
    const Real u = nearestPixel(image.fx, x, z, image.cx), v = nearestPixel(image.fy, y, z, image.cy);
    const Condition in_columns = hn::And(none < u, u < width), in_rows = hn::And(none < v, v < height);
    const Condition seen = hn::And(Real() < z, hn::And(in_columns, in_rows));
    hn::StoreU(choose(seen, v * width + u, none).lanes, d, pixels + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace grasp_affordances
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grasp_affordances
{

HWY_EXPORT(lookUpPixels);

void lookUpPixels(const PinholeImage& image, const double* const points[3], std::size_t count, double* pixels)
{
  HWY_DYNAMIC_DISPATCH(lookUpPixels)(image, points, count, pixels);
}

}  // namespace grasp_affordances
#endif
