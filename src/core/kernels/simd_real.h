// For kernel files, after core/kernels/simd.h: numbers in lanes that read like numbers. No include guard but a toggle:
// it is read once per instruction set.

#if defined(GRASP_AFFORDANCES_SIMD_REAL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRASP_AFFORDANCES_SIMD_REAL
#undef GRASP_AFFORDANCES_SIMD_REAL
#else
#define GRASP_AFFORDANCES_SIMD_REAL
#endif

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace grasp_affordances
{
namespace HWY_NAMESPACE
{

constexpr std::size_t kRealLanes = 8;  // at most

/// Double precision numbers, one for each lane, with the operators of one.
struct Real
{
  using D = hwy::HWY_NAMESPACE::CappedTag<double, kRealLanes>;

  hwy::HWY_NAMESPACE::Vec<D> lanes;

  Real() = default;
  // Numbers and lanes are to mix in formulas.
  // cppcheck-suppress noExplicitConstructor
  HWY_ATTR HWY_INLINE Real(hwy::HWY_NAMESPACE::Vec<D> v) : lanes(v) {}
  // cppcheck-suppress noExplicitConstructor
  HWY_ATTR HWY_INLINE Real(double v) : lanes(hwy::HWY_NAMESPACE::Set(Real::D(), v)) {}
};
using Condition = hwy::HWY_NAMESPACE::Mask<Real::D>;

HWY_ATTR HWY_INLINE Real operator+(Real a, Real b)
{
  return hwy::HWY_NAMESPACE::Add(a.lanes, b.lanes);
}
HWY_ATTR HWY_INLINE Real operator-(Real a, Real b)
{
  return hwy::HWY_NAMESPACE::Sub(a.lanes, b.lanes);
}
HWY_ATTR HWY_INLINE Real operator*(Real a, Real b)
{
  return hwy::HWY_NAMESPACE::Mul(a.lanes, b.lanes);
}
HWY_ATTR HWY_INLINE Real operator/(Real a, Real b)
{
  return hwy::HWY_NAMESPACE::Div(a.lanes, b.lanes);
}
HWY_ATTR HWY_INLINE Real& operator+=(Real& a, Real b)
{
  return a = a + b;
}
HWY_ATTR HWY_INLINE Real& operator-=(Real& a, Real b)
{
  return a = a - b;
}
HWY_ATTR HWY_INLINE Condition operator<(Real a, Real b)
{
  return hwy::HWY_NAMESPACE::Lt(a.lanes, b.lanes);
}
HWY_ATTR HWY_INLINE Real squareRoot(Real a)
{
  return hwy::HWY_NAMESPACE::Sqrt(a.lanes);
}
HWY_ATTR HWY_INLINE Real magnitude(Real a)
{
  return hwy::HWY_NAMESPACE::Abs(a.lanes);
}
HWY_ATTR HWY_INLINE Real smaller(Real a, Real b)
{
  return hwy::HWY_NAMESPACE::Min(a.lanes, b.lanes);
}
HWY_ATTR HWY_INLINE Real larger(Real a, Real b)
{
  return hwy::HWY_NAMESPACE::Max(a.lanes, b.lanes);
}
HWY_ATTR HWY_INLINE Real choose(Condition condition, Real yes, Real no)
{
  return hwy::HWY_NAMESPACE::IfThenElse(condition, yes.lanes, no.lanes);
}

}  // namespace HWY_NAMESPACE
}  // namespace grasp_affordances
HWY_AFTER_NAMESPACE();

#endif
