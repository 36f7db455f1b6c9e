#pragma once

#include "grasp_affordances/cloud.h"

#include "core/cloud/range_image.h"
#include "core/kernels/axis_points.h"
#include "core/shell/cylinder_window.h"

#include <vector>

namespace grasp_affordances
{

/// The points of a cloud within a piece of a cylinder. Keeps its memory from piece to piece.
class CylinderPoints
{
public:
  /// The measured points at [begin, end) along an axis and at most `radius` from it (m), in the frame of the axis. Some
  /// points that are farther from the axis may be among them. Valid until the next call.
  /// @param image  of the cloud: only the pixels onto which the piece projects are read; null: all points are read
  AxisPoints gather(const Cloud& cloud, const RangeImage* image, const AxisFrame& frame, double radius, double begin,
                    double end);

private:
  std::vector<PixelSpan> spans_;
  std::vector<float> chosen_;  // four arrays, one after the other
  std::vector<double> along_, first_, second_;
};

}  // namespace grasp_affordances
