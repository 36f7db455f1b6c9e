// Takes the place of Highway where that is missing: defines what kernel files use of it, with lanes of one number.

#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#define HWY_NAMESPACE N_PORTABLE
#define HWY_ATTR
#define HWY_INLINE inline
#define HWY_ONCE 1
#define HWY_BEFORE_NAMESPACE() static_assert(true, "")
#define HWY_AFTER_NAMESPACE() static_assert(true, "")
#define HWY_EXPORT(FUNCTION) static_assert(true, "")
#define HWY_DYNAMIC_DISPATCH(FUNCTION) HWY_NAMESPACE::FUNCTION

namespace hwy::N_PORTABLE
{

template <typename T>
struct Tag
{
  using Lane = T;
};
template <typename T, std::size_t MaxLanes>
using CappedTag = Tag<T>;
template <typename T, class D>
using Rebind = Tag<T>;
template <class D>
using RebindToSigned = Tag<std::int32_t>;  // of lanes of 32 bits

/// One lane. A type of its own, not a bare number, so that a vector differs from a scalar.
template <typename T>
struct Vector
{
  T lane;
};
template <typename T>
struct Indices
{
};
template <class D>
using Vec = Vector<typename D::Lane>;
template <class D>
using Mask = bool;
template <class V>
struct TagOf;
template <typename T>
struct TagOf<Vector<T>>
{
  using type = Tag<T>;
};
template <class V>
using DFromV = typename TagOf<V>::type;
template <class D>
constexpr std::size_t Lanes(D)
{
  return 1;
}
template <class D>
constexpr std::size_t MaxLanes(D)
{
  return 1;
}

// Values.
template <class D, typename T>
Vec<D> Set(D, T value)
{
  return {static_cast<typename D::Lane>(value)};
}
template <class D>
Vec<D> Zero(D)
{
  return {};
}
template <class D, typename T>
Vec<D> Iota(D, T first)
{
  return {static_cast<typename D::Lane>(first)};
}
template <class D>
Vec<D> Load(D, const typename D::Lane* from)
{
  return {*from};
}
template <class D>
Vec<D> LoadU(D, const typename D::Lane* from)
{
  return {*from};
}
template <typename T, class D>
void Store(Vector<T> v, D, T* to)
{
  *to = v.lane;
}
template <typename T, class D>
void StoreU(Vector<T> v, D, T* to)
{
  *to = v.lane;
}
template <typename T>
T GetLane(Vector<T> v)
{
  return v.lane;
}
template <class D, typename T>
Vec<D> PromoteTo(D, Vector<T> v)
{
  return {static_cast<typename D::Lane>(v.lane)};
}
template <class D, typename T>
Vec<D> BitCast(D, Vector<T> v)
{
  static_assert(sizeof(typename D::Lane) == sizeof(T), "of one size");
  Vec<D> result;
  std::memcpy(&result.lane, &v.lane, sizeof(T));
  return result;
}
template <class D>
Vec<D> GatherIndex(D, const typename D::Lane* from, Vector<std::int32_t> index)
{
  return {from[index.lane]};
}

// Arithmetic.
template <typename T>
Vector<T> Add(Vector<T> a, Vector<T> b)
{
  return {a.lane + b.lane};
}
template <typename T>
Vector<T> Sub(Vector<T> a, Vector<T> b)
{
  return {a.lane - b.lane};
}
template <typename T>
Vector<T> Mul(Vector<T> a, Vector<T> b)
{
  return {a.lane * b.lane};
}
template <typename T>
Vector<T> Div(Vector<T> a, Vector<T> b)
{
  return {a.lane / b.lane};
}
template <typename T>
Vector<T> Sqrt(Vector<T> v)
{
  return {std::sqrt(v.lane)};
}
template <typename T>
Vector<T> Abs(Vector<T> v)
{
  return {std::abs(v.lane)};
}
template <typename T>
Vector<T> Min(Vector<T> a, Vector<T> b)
{
  return {a.lane < b.lane ? a.lane : b.lane};  // the second for NaN, as the processor's instruction
}
template <typename T>
Vector<T> Max(Vector<T> a, Vector<T> b)
{
  return {a.lane > b.lane ? a.lane : b.lane};
}
template <class D, typename T>
Vector<T> MinOfLanes(D, Vector<T> v)
{
  return v;
}
template <class D, typename T>
Vector<T> MaxOfLanes(D, Vector<T> v)
{
  return v;
}
template <typename T>
Vector<T> Floor(Vector<T> v)
{
  return {std::floor(v.lane)};
}

// Comparison, and what is done with masks.
template <typename T>
bool Eq(Vector<T> a, Vector<T> b)
{
  return a.lane == b.lane;
}
template <typename T>
bool Lt(Vector<T> a, Vector<T> b)
{
  return a.lane < b.lane;
}
template <typename T>
bool Le(Vector<T> a, Vector<T> b)
{
  return a.lane <= b.lane;
}
template <typename T>
bool Gt(Vector<T> a, Vector<T> b)
{
  return a.lane > b.lane;
}
template <typename T>
bool Ge(Vector<T> a, Vector<T> b)
{
  return a.lane >= b.lane;
}
inline bool And(bool a, bool b)
{
  return a && b;
}
inline bool AndNot(bool not_a, bool b)
{
  return !not_a && b;
}
inline bool Or(bool a, bool b)
{
  return a || b;
}
inline bool Xor(bool a, bool b)
{
  return a != b;
}
inline bool Not(bool a)
{
  return !a;
}
template <typename T>
Vector<T> IfThenElse(bool mask, Vector<T> yes, Vector<T> no)
{
  return mask ? yes : no;
}
template <typename T>
Vector<T> IfThenElseZero(bool mask, Vector<T> yes)
{
  return mask ? yes : Vector<T>{};
}
template <class D>
bool FirstN(D, std::size_t count)
{
  return count > 0;
}
template <class D>
bool AllTrue(D, bool mask)
{
  return mask;
}
template <class D>
bool AllFalse(D, bool mask)
{
  return !mask;
}
template <class D>
std::size_t CountTrue(D, bool mask)
{
  return mask ? 1 : 0;
}
template <class D>
bool RebindMask(D, bool mask)
{
  return mask;
}
template <class D>
std::size_t StoreMaskBits(D, bool mask, std::uint8_t* bits)
{
  *bits = mask ? 1 : 0;
  return 1;
}

// One lane has only one order.
template <class D, typename T>
Indices<typename D::Lane> IndicesFromVec(D, Vector<T>)
{
  return {};
}
template <typename T>
Vector<T> TableLookupLanes(Vector<T> v, Indices<T>)
{
  return v;
}
template <typename T>
Vector<T> Compress(Vector<T> v, bool)
{
  return v;
}

}  // namespace hwy::N_PORTABLE
