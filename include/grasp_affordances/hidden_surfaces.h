#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/range_image.h"

namespace grasp_affordances
{

/// Points of surfaces that go on behind what the sensor sees: the table beneath a lying can, in the can's own shadow,
/// or the wall behind a handle.
///
/// A plane's image is linear in inverse depth. Wherever two stretches of an image row or column lie on one line, and
/// all pixels between them measured something nearer or nothing, the surface is taken to go on between them; for each
/// such pixel the result, an organized cloud of the same size, has the point of the continued surface, the farther
/// where row and column differ, and NaN elsewhere. Every other row and column is looked at.
/// Bridges at most `max_width` (m).
///
/// Nothing is continued past what was measured behind it: where the sensor saw beyond, there is no surface.
Cloud continueSurfaces(const RangeImage& image, double max_width);

}  // namespace grasp_affordances
