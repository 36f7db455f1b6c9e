#include "rendering/label_place.h"

#include <array>
#include <limits>

namespace grasp_affordances
{
namespace
{

constexpr double kDistance = 6.0;       // pixels between a label and its subject
constexpr double kOutsideWeight = 4.0;  // a pixel outside the picture counts as so many covered pixels

double area(const Rectangle& rectangle)
{
  return rectangle.isEmpty() ? 0.0 : rectangle.volume();
}

}  // namespace

Rectangle labelPlace(const Rectangle& picture, const Rectangle& subject, const Eigen::Vector2d& size,
                     const std::vector<Rectangle>& taken)
{
  static const std::array<Eigen::Vector2d, 8> kDirections{
      {{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {-1, -1}, {1, 1}, {-1, 1}}};
  Rectangle best;
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& direction : kDirections) {
    const Eigen::Vector2d reach = 0.5 * (subject.sizes() + size) + Eigen::Vector2d::Constant(kDistance);
    const Eigen::Vector2d center = subject.center() + direction.cwiseProduct(reach);
    const Rectangle place(center - 0.5 * size, center + 0.5 * size);
    double cost = kOutsideWeight * (area(place) - area(place.intersection(picture)));
    for (const Rectangle& other : taken) {
      cost += area(place.intersection(other));
    }
    if (cost < least) {
      least = cost;
      best = place;
    }
  }
  return best;
}

}  // namespace grasp_affordances
