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
  /// The measured points at [begin, end) along an axis and up to `radius` from it (m), and some that are farther from
  /// it, in the frame of the axis; valid until the next call.
  /// @param image  of the cloud, searched in the window that the piece projects to; null: all of the cloud is looked at
  AxisPoints gather(const Cloud& cloud, const RangeImage* image, const AxisFrame& frame, double radius, double begin,
                    double end);

private:
  std::vector<PixelSpan> spans_;
  std::vector<float> chosen_;  // four arrays
  std::vector<double> along_, first_, second_;
};

}  // namespace grasp_affordances
