#pragma once

#include "core/cloud/range_image.h"
#include "core/kernels/window_scan.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace grasp_affordances
{

/// The points of a cloud within a sphere, in contiguous arrays, in the order of their indices. Keeps its memory from
/// search to search: use one object per thread again and again.
class Neighborhood
{
public:
  Eigen::Vector3f center = Eigen::Vector3f::Zero();  ///< m
  float radius = 0.0F;                               ///< m

  std::size_t size() const { return size_; }
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  const float* z() const { return z_.data(); }
  const std::uint32_t* index() const { return index_.data(); }  ///< of the points in the cloud
  Eigen::Vector3f point(std::size_t i) const { return {x_[i], y_[i], z_[i]}; }

  /// Starts over with no points, around another sphere.
  void clear(const Eigen::Vector3f& new_center, float new_radius);

  /// Appends those of the cloud's points [begin, end) that lie within the sphere.
  void appendRange(const Cloud& cloud, std::size_t begin, std::size_t end);

  /// Appends the cloud's point at `index` if it lies within the sphere.
  void appendPoint(const Cloud& cloud, std::size_t index) { appendRange(cloud, index, index + 1); }

  /// Appends those of the points in a window of an organized cloud that lie within the sphere.
  /// @param with_index  whether index() is asked for; otherwise it is unspecified
  SphereSurvey appendWindow(const Cloud& cloud, const PixelWindow& window, bool with_index = true);

  /// Appends all points of a neighborhood in another cloud, brought to this one's frame. Their indices stay those in
  /// their own cloud.
  void append(const Neighborhood& other, const Eigen::Isometry3d& T_this_other);

  /// Appends all points of another neighborhood, whose cloud holds the same points in another order: `numbers` are
  /// their indices in this one's cloud, by their indices in the other's. They are appended in the order of these
  /// numbers.
  void appendRenumbered(const Neighborhood& other, const std::uint32_t* numbers);

  /// Keeps the k points nearest to the centre, and shrinks the radius to the k-th distance. Of points at the same
  /// distance those with the smaller index are kept. Needs at least k points.
  void keepNearest(std::size_t k);

private:
  SphereSurvey append(const PixelRows& rows, bool with_index);
  void makeRoom(std::size_t points);

  std::size_t size_ = 0;
  std::vector<float> x_, y_, z_;
  std::vector<std::uint32_t> index_;
  std::vector<float> squared_distances_;
  std::vector<std::uint64_t> keys_, spare_keys_;  // to sort points by their numbers
};

/// Finds the points of a cloud around a place. Every implementation returns the same points in the same order: those
/// for which (p - center)^2 <= radius^2 holds in single precision. Around a center that is not finite there are none: a
/// point of another view can overflow in this one's frame. Safe to use from many threads.
class NeighborhoodSearch
{
public:
  virtual ~NeighborhoodSearch() = default;

  /// All measured points within `radius` (m) of `center`.
  virtual void withinRadius(const Eigen::Vector3f& center, float radius, Neighborhood& result) const = 0;

  /// The k measured points nearest to `center`, or all where there are fewer. The result's radius is the distance of
  /// the farthest of them, 0 where there is none.
  virtual void nearest(const Eigen::Vector3f& center, std::size_t k, Neighborhood& result) const = 0;

  /// The range image that is searched; null for a cloud without one.
  virtual const RangeImage* image() const { return nullptr; }
};

/// Searches an organized cloud in the window of pixels that the sphere projects to. The image and its cloud must
/// outlive the search. @param points  number of measured points of the cloud
std::unique_ptr<NeighborhoodSearch> makeWindowSearch(const RangeImage& image, std::size_t points);

/// Searches any cloud in a k-d tree, as TreeSearch does. The cloud must outlive the search.
std::unique_ptr<NeighborhoodSearch> makeTreeSearch(const Cloud& cloud);

}  // namespace grasp_affordances
