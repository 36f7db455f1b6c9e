#include "core/shell/axis_slices.h"

#include "core/result/axis_frame.h"
#include "core/shell/grow_to.h"

#include <algorithm>
#include <cmath>

namespace grasp_affordances
{
namespace
{

ChosenPoints fourArrays(std::vector<float>& memory)
{
  const std::size_t size = memory.size() / 4;
  return {&memory[0], &memory[size], &memory[2 * size], &memory[3 * size]};
}

}  // namespace

void AxisSlices::start(const NeighborhoodSearch* search, const AxisFrame& frame, const Slices& slices, double radius)
{
  search_ = search;
  frame_ = frame;
  slices_ = slices;
  radius_ = radius;
  taken_.assign(slices.count, {});
  size_ = 0;
}

AxisPoints AxisSlices::get(std::size_t slice, double reach)
{
  if (search_ == nullptr) {
    return {};
  }
  if (taken_[slice].reach < std::min(reach, radius_)) {
    gatherAround(slice, reach);
  }
  const Taken& taken = taken_[slice];
  return {along_.data() + taken.begin, first_.data() + taken.begin, second_.data() + taken.begin, taken.size};
}

/// A range image is searched in three parts along the axis. The middle part comes first, because many searches end with
/// it. In the other two parts only the points that a few larger shells reach are gathered. Any other cloud is searched
/// as a whole.
void AxisSlices::gatherAround(std::size_t slice, double reach)
{
  double radius = radius_;
  std::size_t first = 0, last = slices_.count - 1;
  const RangeImage* image = search_->image();
  if (image != nullptr) {
    constexpr std::size_t kMiddle = 2;  // slices to either side of the middle one
    const std::size_t middle = slices_.count / 2;
    const std::size_t middle_first = middle - std::min(middle, kMiddle), middle_last = std::min(middle + kMiddle, last);
    constexpr double kLargerShells = 0.004;  // m
    if (slice >= middle_first && slice <= middle_last) {
      first = middle_first;
      last = middle_last;
    } else {
      radius = std::min(radius_, reach + kLargerShells);
      (slice < middle_first ? last : first) = slice < middle_first ? middle_first - 1 : middle_last + 1;
    }
  }
  const CylinderPiece piece{asVector(frame_.origin), asVector(frame_.axis), radius, slices_.beginOf(first),
                            slices_.endOf(last)};
  const double rounding = roundingWithin(piece);
  const CylinderBounds bounds = looseBounds(piece, rounding);
  const std::size_t chosen = image != nullptr ? chooseInWindow(*image, piece, bounds) : chooseInSphere(piece, bounds);
  dealOut(chosen, first, last, radius, rounding);
}

std::size_t AxisSlices::chooseInWindow(const RangeImage& image, const CylinderPiece& piece,
                                       const CylinderBounds& bounds)
{
  cylinderSpans(image, piece, spans_);
  std::size_t pixels = 0;
  for (const PixelSpan& span : spans_) {
    pixels += span.end - span.begin;
  }
  const Cloud& cloud = image.cloud();
  const float* const points[] = {cloud.x.data(), cloud.y.data(), cloud.z.data()};
  return chooseInCylinder(points, cloud.size(), spans_.data(), spans_.size(), bounds, roomToChoose(pixels));
}

std::size_t AxisSlices::chooseInSphere(const CylinderPiece& piece, const CylinderBounds& bounds)
{
  const double radius = std::hypot(piece.radius, (piece.end - piece.begin) / 2);
  search_->withinRadius(piece.middle().cast<float>(), static_cast<float>(1.0001 * radius), sphere_);
  const float* const points[] = {sphere_.x(), sphere_.y(), sphere_.z()};
  const PixelSpan all{0, sphere_.size()};
  return chooseInCylinder(points, sphere_.size(), &all, 1, bounds, roomToChoose(sphere_.size()));
}

ChosenPoints AxisSlices::roomToChoose(std::size_t count)
{
  growTo(4 * (count + kChoiceSlack), chosen_);
  return fourArrays(chosen_);
}

void AxisSlices::dealOut(std::size_t chosen, std::size_t first, std::size_t last, double reach, double rounding)
{
  const SliceRow row{static_cast<float>(slices_.beginOf(first)), static_cast<float>(slices_.thickness),
                     static_cast<float>(rounding), last - first + 1};
  growTo(row.count, sizes_);
  const auto deal = [&]() {
    growTo(3 * row.count * room_, dealt_);
    float* const dealt[] = {&dealt_[0], &dealt_[row.count * room_], &dealt_[2 * row.count * room_]};
    dealToSlices(fourArrays(chosen_), chosen, row, dealt, room_, sizes_.data());
    return *std::max_element(sizes_.begin(), sizes_.begin() + row.count) + kChoiceSlack;
  };
  for (std::size_t needed = deal(); needed > room_; needed = deal()) {
    room_ = (2 * (needed / kChoiceSlack) + 1) *
            kChoiceSlack;  // odd, so that the slices' ends fall into different cache sets
  }

  for (std::size_t i = 0; i < row.count; ++i) {
    for (std::vector<double>* memory : {&along_, &first_, &second_}) {
      growTo(size_ + sizes_[i] + kAxisPointGroup, *memory);
    }
    const float* const dealt[] = {&dealt_[i * room_], &dealt_[(row.count + i) * room_],
                                  &dealt_[(2 * row.count + i) * room_]};
    const std::size_t size = takeSlice(dealt, sizes_[i], frame_, slices_.beginOf(first + i), slices_.endOf(first + i),
                                       {&along_[size_], &first_[size_], &second_[size_]});
    taken_[first + i] = {reach, size_, size};
    size_ += size;
  }
}

}  // namespace grasp_affordances
