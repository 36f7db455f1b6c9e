#include "openni2/field_of_view.h"

#include <cmath>

namespace grasp_affordances
{

std::optional<PinholeIntrinsics> pinholeIntrinsics(const FieldOfView& field_of_view, int width, int height)
{
  const auto [horizontal, vertical] = field_of_view;
  constexpr double kPi = 3.14159265358979323846;
  const auto possible = [](double angle) { return angle > 0.0 && angle < kPi; };
  if (!possible(horizontal) || !possible(vertical)) {
    return std::nullopt;
  }
  const int rows = 5 * height == 4 * width ? 3 * width / 4 : height;
  return PinholeIntrinsics{width / (2.0 * std::tan(horizontal / 2.0)), rows / (2.0 * std::tan(vertical / 2.0)),
                           (width - 1) / 2.0, (rows - 1) / 2.0};
}

}  // namespace grasp_affordances
