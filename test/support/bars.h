#pragma once

#include "core/shell/shell.h"
#include "support/points.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace grasp_affordances::test
{

constexpr double kSpacing = 0.0015;  // m
inline const HandGeometry kHand{0.026, 0.008};

inline ShellConfig paperShell()
{
  return presetConfig("paper").shell;
}

inline ShellConfig localizerShell()
{
  return presetConfig("localizer").shell;
}

inline FittedCylinder fittedCylinder(double radius)
{
  return {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), radius};
}

/// A bar about the z axis, as long as it is asked for, seen from one side.
inline Points bar(double radius, double length, std::uint64_t seed = 1)
{
  Random random(seed);
  const double area = M_PI * radius * length;
  return cylinderPoints(radius, M_PI, length, static_cast<std::size_t>(area / (kSpacing * kSpacing)), random);
}

/// A wall at a distance from the axis, parallel to it.
inline Points wall(double distance)
{
  Points points;
  for (double x = -0.05; x < 0.05; x += kSpacing) {
    for (double z = -0.06; z < 0.06; z += kSpacing) {
      points.emplace_back(x, -distance, z);
    }
  }
  return points;
}

inline Points operator+(Points a, const Points& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline ShellSearchResult searchShell(const Points& points, double fitted_radius, const ShellConfig& config)
{
  const Cloud cloud = cloudOf(points);
  const auto search = makeTreeSearch(cloud);
  return ShellSearch().search({*search, nullptr, nullptr, kSpacing}, fittedCylinder(fitted_radius), kHand, config);
}

/// An image of an upright bar at a depth of 0.8 m before a wall, and what of it an obstacle or a hole hides.
class BarImage
{
public:
  /// `hidden(y)`: depth (m; NaN: not measured) of what hides the bar at a height (m), or 0 for nothing.
  template <typename Hidden>
  BarImage(double radius, double half_length, Hidden&& hidden) : cylinder_{{0, 0, kDepth}, {0, 1, 0}, 0.9 * radius}
  {
    cloud_.reset(320, 240);
    cloud_.intrinsics = PinholeIntrinsics{480.0, 480.0, 159.5, 119.5};
    for (std::uint32_t v = 0; v < cloud_.height; ++v) {
      for (std::uint32_t u = 0; u < cloud_.width; ++u) {
        const double slope_x = (u - 159.5) / 480.0, slope_y = (v - 119.5) / 480.0;
        const double x = slope_x * kDepth, y = slope_y * kDepth;
        double z = 1.2;
        if (std::abs(x) < radius && std::abs(y) < half_length) {
          z = hidden(y) == 0.0 ? kDepth - std::sqrt(radius * radius - x * x) : hidden(y);
        }
        cloud_.set(v * cloud_.width + u, static_cast<float>(slope_x * z), static_cast<float>(slope_y * z),
                   static_cast<float>(z));
      }
    }
    std::string warning;
    image_ = RangeImage::create(cloud_, warning);
    search_ = makeWindowSearch(*image_, cloud_.size());
  }
  BarImage(const BarImage&) = delete;
  BarImage& operator=(const BarImage&) = delete;

  ShellSearchResult search(const ShellConfig& config) const { return search(*search_, config); }
  ShellSearchResult search(const NeighborhoodSearch& search, const ShellConfig& config) const
  {
    return ShellSearch().search({search, nullptr, &*image_, image_->spacing(kDepth)}, cylinder_, kHand, config);
  }
  ShellSearchResult search(ShellSearch& search, const ShellConfig& config) const
  {
    return search.search({*search_, nullptr, &*image_, image_->spacing(kDepth)}, cylinder_, kHand, config);
  }
  const RangeImage& image() const { return *image_; }

private:
  static constexpr double kDepth = 0.8;

  FittedCylinder cylinder_;
  Cloud cloud_;
  std::optional<RangeImage> image_;
  std::unique_ptr<NeighborhoodSearch> search_;
};

}  // namespace grasp_affordances::test
