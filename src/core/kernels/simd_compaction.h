// For kernel files, after core/kernels/simd.h: keeps some of the lanes of a vector. No include guard but a toggle: it
// is read once per instruction set.

#if defined(GRASP_AFFORDANCES_SIMD_COMPACTION) == defined(HWY_TARGET_TOGGLE)
#ifdef GRASP_AFFORDANCES_SIMD_COMPACTION
#undef GRASP_AFFORDANCES_SIMD_COMPACTION
#else
#define GRASP_AFFORDANCES_SIMD_COMPACTION
#endif

#include "core/kernels/lane_order.h"

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace grasp_affordances
{
namespace HWY_NAMESPACE
{

/// Moves the lanes that a mask keeps to the front, in their order; what follows them is unspecified. For lanes of 32
/// bits. Highway's own Compress copies its table to the stack at each call where GCC compiles it for AVX2 or SSE.
template <class D>
class Compaction
{
public:
  HWY_ATTR HWY_INLINE explicit Compaction(hwy::HWY_NAMESPACE::Mask<D> keep)
      : count(hwy::HWY_NAMESPACE::CountTrue(D(), keep)), keep_(keep)
  {
    namespace hn = hwy::HWY_NAMESPACE;
    if constexpr (hn::MaxLanes(D()) <= kOrderedLanes) {
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(D(), keep, bits);
      const hn::Rebind<std::uint8_t, D> bytes;
      order_ = hn::PromoteTo(hn::RebindToSigned<D>(), hn::LoadU(bytes, kLaneOrder[bits[0]].data()));
    }
  }

  template <class V>
  HWY_ATTR HWY_INLINE V operator()(V vector) const
  {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::DFromV<V> d;
    if constexpr (hn::MaxLanes(D()) <= kOrderedLanes) {
      return hn::TableLookupLanes(vector, hn::IndicesFromVec(d, order_));
    } else {
      return hn::Compress(vector, hn::RebindMask(d, keep_));
    }
  }

  std::size_t count;  ///< of lanes kept

private:
  hwy::HWY_NAMESPACE::Mask<D> keep_;
  hwy::HWY_NAMESPACE::Vec<hwy::HWY_NAMESPACE::RebindToSigned<D>> order_;
};

}  // namespace HWY_NAMESPACE
}  // namespace grasp_affordances
HWY_AFTER_NAMESPACE();

#endif
