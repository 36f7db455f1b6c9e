#pragma once

#include "core/cloud/range_image.h"
#include "core/shell/shell.h"

#include <Eigen/Core>

#include <vector>

namespace grasp_affordances
{

/// Share of a shell's gap that the sensor saw through. It is computed on a lattice of points in the gap, which has a
/// fixed number of points and a fixed place relative to the shell. A point is free where its pixel measured a range
/// beyond it. Points outside the image, or on a pixel without a measurement, are not free. An object shadows the gap
/// behind it: even one that stands alone reaches little more than one half.
/// @param axis, normal  orthonormal
/// @param thickness  m, of the gap
/// @param others  further views; a point that one of them saw as free is free. Null: none
double observedFreeShare(const RangeImage& image, const ShellSearchResult& shell, const Eigen::Vector3d& axis,
                         const Eigen::Vector3d& normal, double thickness,
                         const std::vector<OtherView>* others = nullptr);

/// Share of a shell's silhouette, as the sensor sees it, that shows surface inside the shell. It is computed on a
/// lattice of points across the inner radius and along the length: the number of points whose pixel measured something
/// inside the shell, over the number whose pixel measured something inside or behind it. Pixels that measured something
/// in front of the shell do not count. Zero where no pixel counts.
///
/// A bar fills its silhouette. The rim of a mug, or an edge of something larger, does not.
/// @param axis, normal  orthonormal
double silhouetteCoverage(const RangeImage& image, const ShellSearchResult& shell, const Eigen::Vector3d& axis,
                          const Eigen::Vector3d& normal);

}  // namespace grasp_affordances
