#include "core/shell/cylinder_points.h"

#include "core/result/axis_frame.h"
#include "core/shell/grow_to.h"

#include <cstddef>

namespace grasp_affordances
{

AxisPoints CylinderPoints::gather(const Cloud& cloud, const RangeImage* image, const AxisFrame& frame, double radius,
                                  double begin, double end)
{
  const CylinderPiece piece{asVector(frame.origin), asVector(frame.axis), radius, begin, end};
  if (image != nullptr) {
    cylinderSpans(*image, piece, spans_);
  } else {
    spans_.assign(1, {0, cloud.size()});
  }
  std::size_t candidates = 0;
  for (const PixelSpan& span : spans_) {
    candidates += span.end - span.begin;
  }
  growTo(4 * (candidates + kChoiceSlack), chosen_);
  const std::size_t room = chosen_.size() / 4;
  float* const chosen[] = {&chosen_[0], &chosen_[room], &chosen_[2 * room], &chosen_[3 * room]};
  const float* const points[] = {cloud.x.data(), cloud.y.data(), cloud.z.data()};
  const std::size_t count =
      chooseInCylinder(points, cloud.size(), spans_.data(), spans_.size(), looseBounds(piece, roundingWithin(piece)),
                       {chosen[0], chosen[1], chosen[2], chosen[3]});
  for (std::vector<double>* memory : {&along_, &first_, &second_}) {
    growTo(count + kAxisPointGroup, *memory);
  }
  const float* const coordinates[] = {chosen[0], chosen[1], chosen[2]};
  const std::size_t size =
      takeSlice(coordinates, count, frame, begin, end, {along_.data(), first_.data(), second_.data()});
  return {along_.data(), first_.data(), second_.data(), size};
}

}  // namespace grasp_affordances
