#include "core/neighborhoods/neighborhoods.h"

#include "core/cloud/pixel_rows.h"
#include "core/kernels/nearest.h"
#include "core/neighborhoods/tree_search.h"
#include "core/neighborhoods/window_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace grasp_affordances
{
namespace
{

/// Sorts `count` keys by those of their bits that differ, the lowest first, in passes over a few bits each. The keys
/// are a number (upper half) and a place (lower half), and are sorted by number alone.
void sortByNumber(std::vector<std::uint64_t>& keys, std::vector<std::uint64_t>& spare, std::size_t count,
                  std::uint32_t largest)
{
  constexpr std::size_t kFew = 256;
  if (count < kFew) {
    std::sort(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(count));
    return;
  }
  constexpr unsigned kBits = 11;  // of a pass
  constexpr std::uint64_t kValues = std::uint64_t{1} << kBits;
  std::array<std::uint32_t, kValues> place;
  for (unsigned shift = 0; (largest >> shift) > 0; shift += kBits) {
    const auto digit = [shift](std::uint64_t key) { return (key >> (32U + shift)) & (kValues - 1); };
    place.fill(0);
    for (std::size_t i = 0; i < count; ++i) {
      ++place[digit(keys[i])];
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& p : place) {
      const std::uint32_t points = p;
      p = sum;
      sum += points;
    }
    for (std::size_t i = 0; i < count; ++i) {
      spare[place[digit(keys[i])]++] = keys[i];
    }
    keys.swap(spare);
  }
}

}  // namespace

void Neighborhood::clear(const Eigen::Vector3f& new_center, float new_radius)
{
  center = new_center;
  radius = new_radius;
  size_ = 0;
}

void Neighborhood::appendRange(const Cloud& cloud, std::size_t begin, std::size_t end)
{
  makeRoom(end - begin);
  size_ += gatherUnsurveyed({cloud.x.data(), cloud.y.data(), cloud.z.data(), cloud.size(), begin, 1, end - begin, 0},
                            center.data(), radius * radius, {&x_[size_], &y_[size_], &z_[size_], &index_[size_]});
}

SphereSurvey Neighborhood::appendWindow(const Cloud& cloud, const PixelWindow& window, bool with_index)
{
  return append(pixelRows(cloud, window), with_index);
}

void Neighborhood::append(const Neighborhood& other, const Eigen::Isometry3d& T_this_other)
{
  makeRoom(other.size_);
  for (std::size_t i = 0; i < other.size_; ++i, ++size_) {
    const Eigen::Vector3d point = T_this_other * other.point(i).cast<double>();
    x_[size_] = static_cast<float>(point.x());
    y_[size_] = static_cast<float>(point.y());
    z_[size_] = static_cast<float>(point.z());
    index_[size_] = other.index_[i];
  }
}

void Neighborhood::appendRenumbered(const Neighborhood& other, const std::uint32_t* numbers)
{
  makeRoom(other.size_);
  if (keys_.size() < other.size_) {
    keys_.resize(2 * other.size_);
    spare_keys_.resize(keys_.size());
  }
  std::uint32_t smallest = std::numeric_limits<std::uint32_t>::max(), largest = 0, before = 0;
  bool sorted = true;
  for (std::size_t i = 0; i < other.size_; ++i) {
    const std::uint32_t number = numbers[other.index_[i]];
    keys_[i] = std::uint64_t{number} << 32U | i;
    smallest = std::min(smallest, number);
    largest = std::max(largest, number);
    sorted = sorted && before <= number;
    before = number;
  }
  if (!sorted) {
    const std::uint64_t offset = std::uint64_t{smallest} << 32U;
    for (std::size_t i = 0; i < other.size_; ++i) {
      keys_[i] -= offset;
    }
    sortByNumber(keys_, spare_keys_, other.size_, largest - smallest);
  }
  const std::uint32_t first = sorted ? 0 : smallest;
  for (std::size_t i = 0; i < other.size_; ++i, ++size_) {
    const auto place = static_cast<std::uint32_t>(keys_[i]);
    x_[size_] = other.x_[place];
    y_[size_] = other.y_[place];
    z_[size_] = other.z_[place];
    index_[size_] = static_cast<std::uint32_t>(keys_[i] >> 32U) + first;
  }
}

void Neighborhood::makeRoom(std::size_t points)
{
  const std::size_t needed = size_ + points + kGatherSlack;
  if (needed > x_.size()) {
    const std::size_t room = std::max(needed, 2 * x_.size());
    x_.resize(room);
    y_.resize(room);
    z_.resize(room);
    index_.resize(room);
  }
}

SphereSurvey Neighborhood::append(const PixelRows& rows, bool with_index)
{
  makeRoom(rows.rows * rows.columns);
  const SphereSurvey survey = gatherSphere(rows, center.data(), radius * radius,
                                           {&x_[size_], &y_[size_], &z_[size_], with_index ? &index_[size_] : nullptr});
  size_ += survey.points;
  return survey;
}

void Neighborhood::keepNearest(std::size_t k)
{
  if (k == 0) {
    radius = 0.0F;
    size_ = 0;
    return;
  }
  squared_distances_.resize(std::max(squared_distances_.size(), size_ + kGatherSlack));
  const float squared = grasp_affordances::keepNearest({x_.data(), y_.data(), z_.data(), index_.data()}, size_,
                                                       center.data(), k, squared_distances_.data());
  size_ = k;
  radius = std::sqrt(squared);
}

void WindowSearch::withinRadius(const Eigen::Vector3f& center, float radius, Neighborhood& result) const
{
  gather(center, radius, true, result);
}

SphereView WindowSearch::look(const Eigen::Vector3f& center, float radius) const
{
  const PixelWindow window = image_.window(center.cast<double>(), radius);
  return {center, radius, window, surveySphere(pixelRows(image_.cloud(), window), center.data(), radius * radius)};
}

SphereView WindowSearch::gather(const Eigen::Vector3f& center, float radius, bool with_index,
                                Neighborhood& result) const
{
  const PixelWindow window = image_.window(center.cast<double>(), radius);
  result.clear(center, radius);
  return {center, radius, window, result.appendWindow(image_.cloud(), window, with_index)};
}

void WindowSearch::nearest(const Eigen::Vector3f& center, std::size_t k, Neighborhood& result) const
{
  k = center.allFinite() ? std::min(k, points_) : 0;
  // A disc of k pixels on a surface that faces the sensor, and a little more for one that does not.
  double radius = 1.3 * std::sqrt(k / M_PI) * image_.spacing(std::max(1e-3, std::abs(static_cast<double>(center.z()))));
  do {
    withinRadius(center, static_cast<float>(radius), result);
    radius *= 2.0;
  } while (result.size() < k);
  result.keepNearest(k);
}

std::unique_ptr<NeighborhoodSearch> makeWindowSearch(const RangeImage& image, std::size_t points)
{
  return std::make_unique<WindowSearch>(image, points);
}

std::unique_ptr<NeighborhoodSearch> makeTreeSearch(const Cloud& cloud)
{
  auto search = std::make_unique<TreeSearch>();
  search->update(cloud);
  return search;
}

}  // namespace grasp_affordances
