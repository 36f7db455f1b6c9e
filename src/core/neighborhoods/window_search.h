#pragma once

#include "core/cloud/range_image.h"
#include "core/neighborhoods/neighborhoods.h"
#include "core/neighborhoods/sphere_view.h"

#include <Eigen/Core>

#include <cstddef>

namespace grasp_affordances
{

/// Searches an organized cloud in the window of pixels that the sphere projects to. The image must outlive the search.
class WindowSearch : public NeighborhoodSearch
{
public:
  /// @param points  number of measured points of the cloud
  WindowSearch(const RangeImage& image, std::size_t points) : image_(image), points_(points) {}

  void withinRadius(const Eigen::Vector3f& center, float radius, Neighborhood& result) const override;
  void nearest(const Eigen::Vector3f& center, std::size_t k, Neighborhood& result) const override;

  /// As withinRadius(), with or without the points' indices. @return what the sensor sees of the sphere
  SphereView gather(const Eigen::Vector3f& center, float radius, bool with_index, Neighborhood& result) const;

  /// What the sensor sees of a sphere, without gathering its points, in less time than gather().
  SphereView look(const Eigen::Vector3f& center, float radius) const;

  const RangeImage* image() const override { return &image_; }

private:
  const RangeImage& image_;
  std::size_t points_;
};

}  // namespace grasp_affordances
