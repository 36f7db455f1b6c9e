#include "core/kernels/quadric_curvatures.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/quadric_curvatures.cpp"
#include "core/kernels/simd.h"
#include "core/kernels/simd_real.h"

HWY_BEFORE_NAMESPACE();
namespace grasp_affordances
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;
static_assert(kCurvatureBatch == kRealLanes);

struct Vector3
{
  Real x, y, z;
};

HWY_ATTR HWY_INLINE Real dot(const Vector3& a, const Vector3& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// A symmetric matrix, the same in all lanes.
struct Symmetric3
{
  Real xx, yy, zz, xy, yz, xz;

  HWY_ATTR HWY_INLINE Vector3 operator*(const Vector3& v) const
  {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z};
  }
  HWY_ATTR HWY_INLINE Real trace() const { return xx + yy + zz; }
  HWY_ATTR HWY_INLINE Symmetric3 adjugate() const
  {
    return {yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy,
            xz * yz - xy * zz, xy * xz - xx * yz, xy * yz - xz * yy};
  }
};

HWY_ATTR CurvatureCounts quadricCurvatures(const QuadricCoefficients& quadric, const double sensor[3],
                                           std::size_t count, const CurvaturePoints& points)
{
  const Real::D d;
  const Real two(2.0), zero(0.0), infinity(std::numeric_limits<double>::infinity());
  const Symmetric3 A{quadric.xx, quadric.yy, quadric.zz, quadric.xy, quadric.yz, quadric.xz};
  const Symmetric3 hessian{two * A.xx, two * A.yy, two * A.zz, two * A.xy, two * A.yz, two * A.xz};
  const Symmetric3 adjugate = hessian.adjugate();
  const Real trace = hessian.trace();
  const Vector3 b{quadric.x, quadric.y, quadric.z};
  const Real constant(quadric.constant);
  const Vector3 origin{sensor[0], sensor[1], sensor[2]};

  CurvatureCounts counts;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    Vector3 x{hn::LoadU(d, points.x + i), hn::LoadU(d, points.y + i), hn::LoadU(d, points.z + i)};
    const Vector3 half = A * x;
    Vector3 gradient{two * half.x + b.x, two * half.y + b.y, two * half.z + b.z};
    const Real value = dot(x, {half.x + b.x, half.y + b.y, half.z + b.z}) + constant;
    const Real step = value / dot(gradient, gradient);
    x = {x.x - step * gradient.x, x.y - step * gradient.y, x.z - step * gradient.z};

    const Vector3 bent = hessian * x;
    gradient = {bent.x + b.x, bent.y + b.y, bent.z + b.z};
    // Mean and Gaussian curvature, times the gradient's norm and its square.
    const Real squared_norm = dot(gradient, gradient), inverse = Real(1.0) / squared_norm;
    const Real mean = (trace - dot(gradient, hessian * gradient) * inverse) * Real(0.5);
    const Real gaussian = dot(gradient, adjugate * gradient) * inverse;
    const Real deviation = squareRoot(larger(zero, mean * mean - gaussian));
    const Real curvature = magnitude(mean) + deviation;
    const Real squared = curvature * curvature * inverse;

    // False for NaN.
    const Condition valid =
        hn::And(hn::And(hn::Not(Real(1.0) < dot(x, x)), squared < infinity), hn::FirstN(d, count - i));
    const Vector3 to_sensor{origin.x - x.x, origin.y - x.y, origin.z - x.z};
    // The surface bends away from its gradient's side where the mean curvature is positive.
    const Real side = dot(gradient, to_sensor);
    const Condition towards_sensor = hn::Not(side < zero), inward = mean < zero;
    const Condition concave = hn::And(hn::Not(hn::Xor(towards_sensor, inward)), zero < squared);

    hn::StoreU(x.x.lanes, d, points.x + i);
    hn::StoreU(x.y.lanes, d, points.y + i);
    hn::StoreU(x.z.lanes, d, points.z + i);
    hn::StoreU(choose(valid, squared, infinity).lanes, d, points.squared_curvature + i);
    counts.valid += hn::CountTrue(d, valid);
    counts.concave += hn::CountTrue(d, hn::And(valid, concave));
  }
  return counts;
}

}  // namespace HWY_NAMESPACE
}  // namespace grasp_affordances
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grasp_affordances
{

HWY_EXPORT(quadricCurvatures);

CurvatureCounts quadricCurvatures(const QuadricCoefficients& quadric, const double sensor[3], std::size_t count,
                                  const CurvaturePoints& points)
{
  return HWY_DYNAMIC_DISPATCH(quadricCurvatures)(quadric, sensor, count, points);
}

}  // namespace grasp_affordances
#endif
