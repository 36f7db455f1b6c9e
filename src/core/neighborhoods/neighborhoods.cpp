#include "core/neighborhoods/neighborhoods.h"

#include "core/cloud/pixel_rows.h"
#include "core/kernels/nearest.h"
#include "core/neighborhoods/window_search.h"

#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#if __has_include(<pcl/memory.h>)
#include <pcl/memory.h>
#else  // PCL 1.10
#include <pcl/make_shared.h>
#endif

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace grasp_affordances
{
namespace
{

/// The tree computes distances in its own way. So it is asked for a slightly larger sphere, and Neighborhood decides
/// which of the points it finds are within. Where spheres hold a good part of the cloud, the whole cloud is gone
/// through instead: that finds the same points and is much faster.
class TreeSearch : public NeighborhoodSearch
{
public:
  explicit TreeSearch(const Cloud& cloud) : cloud_(cloud)
  {
    // Not by new: the libraries of PCL are not C++17, and there the class has another operator new.
    const auto points = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (cloud.measured(i)) {
        points->push_back({cloud.x[i], cloud.y[i], cloud.z[i]});
        index_.push_back(static_cast<std::uint32_t>(i));
      }
    }
    tree_.setSortedResults(false);
    if (!index_.empty()) {
      tree_.setInputCloud(points);
    }
  }

  void withinRadius(const Eigen::Vector3f& center, float radius, Neighborhood& result) const override
  {
    result.clear(center, radius);
    if (index_.empty() || !center.allFinite()) {
      return;
    }
    if (crowded_.load(std::memory_order_relaxed)) {
      result.appendRange(cloud_, 0, cloud_.size());
    } else {
      appendFromTree(center, radius, result);
    }
    crowded_.store(result.size() > cloud_.size() / kCrowd, std::memory_order_relaxed);
  }

  void nearest(const Eigen::Vector3f& center, std::size_t k, Neighborhood& result) const override
  {
    k = center.allFinite() ? std::min(k, index_.size()) : 0;
    double radius = kSmallestRadius;
    if (k > 0) {
      static thread_local std::vector<int> found;
      static thread_local std::vector<float> squared_distances;
      tree_.nearestKSearch(toPcl(center), static_cast<int>(k), found, squared_distances);
      radius = std::max(radius,
                        kInflation * std::sqrt(*std::max_element(squared_distances.begin(), squared_distances.end())));
    }
    // The tree gives fewer than k where squares overflow, and its k-th distance differs from ours in the last bits.
    withinRadius(center, static_cast<float>(radius), result);
    for (; result.size() < k && radius < kLargestRadius; radius *= 2.0) {
      withinRadius(center, static_cast<float>(radius), result);
    }
    if (result.size() < k) {
      result.clear(center, std::numeric_limits<float>::infinity());
      result.appendRange(cloud_, 0, cloud_.size());
    }
    result.keepNearest(k);
  }

private:
  static constexpr double kInflation = 1.0001;
  static constexpr double kSmallestRadius = 1e-18;  // m; within a radius of zero the tree finds nothing
  static constexpr double kLargestRadius = 1e18;    // m; the square of a larger radius overflows
  static constexpr std::size_t kCrowd = 64;  // finding a point in the tree costs as much as going through so many

  static pcl::PointXYZ toPcl(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }

  void appendFromTree(const Eigen::Vector3f& center, float radius, Neighborhood& result) const
  {
    static thread_local std::vector<int> found;
    static thread_local std::vector<float> squared_distances;
    tree_.radiusSearch(toPcl(center), std::max(kInflation * radius, kSmallestRadius), found, squared_distances);
    std::sort(found.begin(), found.end());
    for (const int i : found) {
      result.appendPoint(cloud_, index_[i]);
    }
  }

  const Cloud& cloud_;
  std::vector<std::uint32_t> index_;  // of the tree's points in the cloud
  pcl::KdTreeFLANN<pcl::PointXYZ> tree_;
  mutable std::atomic<bool> crowded_{false};  // whether the sphere searched last held many of the points
};

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
  return std::make_unique<TreeSearch>(cloud);
}

}  // namespace grasp_affordances
