#pragma once

#include "simulation/measured_image.h"
#include "simulation/sensor_model.h"

namespace grasp_affordances
{

/// Registers the depth camera's own image to the camera beside it, as drivers do: each pixel becomes the rectangle that
/// it covers in the other image at its depth, and where rectangles meet the nearest one counts. What the other camera
/// sees but the depth camera does not stays without a measurement: a second shadow.
/// @param own of the size of model.depth_camera
/// @return of the size of the model's image
MeasuredImage registered(const MeasuredImage& own, const SensorModel& model);

}  // namespace grasp_affordances
