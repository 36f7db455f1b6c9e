// For kernel files, after core/kernels/simd.h: runs over rows of single precision numbers. No include guard but a
// toggle: it is read once per instruction set.

#if defined(GRASP_AFFORDANCES_SIMD_ROWS) == defined(HWY_TARGET_TOGGLE)
#ifdef GRASP_AFFORDANCES_SIMD_ROWS
#undef GRASP_AFFORDANCES_SIMD_ROWS
#else
#define GRASP_AFFORDANCES_SIMD_ROWS
#endif

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace grasp_affordances
{
namespace HWY_NAMESPACE
{

/// Calls scan(tag, index of the first number, mask of those that count) for the numbers [begin, end) of arrays of
/// `size`, as many at a time as there are lanes; at the end of the arrays one at a time.
template <class Scan>
HWY_ATTR HWY_INLINE void scanRow(std::size_t begin, std::size_t end, std::size_t size, Scan&& scan)
{
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::CappedTag<float, 16> f;
  std::size_t i = begin;
  for (; i + hn::Lanes(f) <= end; i += hn::Lanes(f)) {
    scan(f, i, hn::FirstN(f, hn::Lanes(f)));
  }
  if (i < end && i + hn::Lanes(f) <= size) {
    scan(f, i, hn::FirstN(f, end - i));
    return;
  }
  const hn::CappedTag<float, 1> single;
  for (; i < end; ++i) {
    scan(single, i, hn::FirstN(single, 1));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace grasp_affordances
HWY_AFTER_NAMESPACE();

#endif
