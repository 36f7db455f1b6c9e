#include "simulation/disparity_image.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace grasp_affordances
{

DisparityImage::DisparityImage(const std::vector<float>& depth, int width, int height, const PinholeIntrinsics& camera,
                               double baseline)
    : width_(width), height_(height), camera_(camera), disparity_(depth.size())
{
  const auto focal_baseline = static_cast<float>(camera.fx * baseline);
  std::transform(depth.begin(), depth.end(), disparity_.begin(), [&](float z) { return focal_baseline / z; });
}

bool DisparityImage::parted(Pixel a, Pixel b) const
{
  const int distance = std::abs(a.column - b.column) + std::abs(a.row - b.row);
  return distance > 0 && std::abs((*this)(a) - (*this)(b)) >= static_cast<float>(distance);
}

bool DisparityImage::edgeWithin(int reach, Pixel p) const
{
  for (int distance = 1; distance <= reach; ++distance) {
    for (const Pixel other : {Pixel{p.column - distance, p.row}, Pixel{p.column + distance, p.row},
                              Pixel{p.column, p.row - distance}, Pixel{p.column, p.row + distance}}) {
      if (contains(other) && parted(p, other))
        return true;
    }
  }
  return false;
}

Eigen::Vector3d DisparityImage::ray(Pixel p) const
{
  return {(p.column - camera_.cx) / camera_.fx, (p.row - camera_.cy) / camera_.fy, 1.0};
}

Eigen::Vector3d DisparityImage::normal(Pixel p) const
{
  const Eigen::Vector3d r = ray(p);
  const double x = camera_.fx * gradient(p, {p.column - 1, p.row}, {p.column + 1, p.row});
  const double y = camera_.fy * gradient(p, {p.column, p.row - 1}, {p.column, p.row + 1});
  return {x, y, (*this)(p)-x * r.x() - y * r.y()};
}

/// Change of disparity per pixel, from the neighbor with the smaller change: that one is on the same surface.
double DisparityImage::gradient(Pixel p, Pixel before, Pixel after) const
{
  const double here = (*this)(p);
  if (!contains(before))
    return contains(after) ? (*this)(after)-here : 0.0;
  if (!contains(after))
    return here - (*this)(before);
  const double rise_before = here - (*this)(before);
  const double rise_after = (*this)(after)-here;
  return std::abs(rise_before) < std::abs(rise_after) ? rise_before : rise_after;
}

}  // namespace grasp_affordances
