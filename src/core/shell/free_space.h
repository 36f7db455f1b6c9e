#pragma once

#include "core/cloud/range_image.h"
#include "core/shell/shell.h"

#include <Eigen/Core>

#include <vector>

namespace grasp_affordances
{

/// Share of a shell's gap that the sensor saw through: of a lattice of points in the gap, fixed in number and relative
/// to the shell (`axis` and `normal` orthonormal), those whose pixel measured a range beyond them. Points outside
/// the image or on a pixel without a measurement are not seen as free. An object shadows the gap behind itself, so that
/// also a free-standing one reaches little more than one half.
/// @param others  further views, in each of which a point may be seen as free; null for none
double observedFreeShare(const RangeImage& image, const ShellSearchResult& shell, const Eigen::Vector3d& axis,
                         const Eigen::Vector3d& normal, double thickness,
                         const std::vector<OtherView>* others = nullptr);

/// Share of a shell's silhouette, as the sensor sees it, that shows surface inside the shell: of a lattice of points
/// across the inner radius and along the length, those whose pixel measured a point inside, among those whose pixel
/// measured one inside or behind. A bar fills its silhouette; the rim of a mug, or a sliver of something larger, does
/// not. Zero where nothing was measured; what is in front of the shell does not count.
double silhouetteCoverage(const RangeImage& image, const ShellSearchResult& shell, const Eigen::Vector3d& axis,
                          const Eigen::Vector3d& normal);

}  // namespace grasp_affordances
