#include "simulation/chain_axes.h"

#include "simulation/primitive.h"

#include <algorithm>

namespace grasp_affordances
{
namespace
{

/// A part's axes, in both directions.
std::vector<PartAxis> axesOf(const Scene& scene, std::size_t part)
{
  const Part& p = scene.parts()[part];
  std::vector<PartAxis> result;
  for (const GripAxis& axis : gripAxes(p.shape, p.T_scene_shape.linear())) {
    const Eigen::Vector3d start = p.T_scene_shape * axis.sectionFrame(0.0).translation();
    const Eigen::Vector3d end = p.T_scene_shape * axis.sectionFrame(axis.length()).translation();
    result.push_back({part, axis, false, start, end});
    result.push_back({part, axis, true, end, start});
  }
  return result;
}

/// One axis per part of a chain. Its direction is such that it starts near the end of the part before.
std::vector<PartAxis> chainAxes(const Scene& scene, const std::vector<std::size_t>& chain)
{
  std::vector<std::vector<PartAxis>> options;
  for (const std::size_t part : chain) {
    options.push_back(axesOf(scene, part));
    if (options.back().empty())
      options.pop_back();
  }
  std::vector<PartAxis> result;
  for (std::size_t i = 0; i < options.size(); ++i) {
    const auto gap = [&](const PartAxis& option) {
      if (i > 0)
        return (option.first - result.back().last).norm();
      double least = kNoIntersection;
      if (options.size() > 1) {
        for (const PartAxis& next : options[1])
          least = std::min(least, (next.first - option.last).norm());
      }
      return least;
    };
    result.push_back(*std::min_element(options[i].begin(), options[i].end(),
                                       [&](const PartAxis& a, const PartAxis& b) { return gap(a) < gap(b); }));
  }
  return result;
}

}  // namespace

std::vector<std::vector<PartAxis>> axisAlternatives(const Scene& scene, std::size_t part)
{
  for (const std::vector<std::size_t>& chain : scene.chains()) {
    if (chain.size() > 1 && std::find(chain.begin(), chain.end(), part) != chain.end()) {
      if (part != *std::min_element(chain.begin(), chain.end()))
        return {};
      return {chainAxes(scene, chain)};
    }
  }
  std::vector<std::vector<PartAxis>> result;
  for (const PartAxis& axis : axesOf(scene, part)) {
    if (!axis.reversed)
      result.push_back({axis});
  }
  return result;
}

}  // namespace grasp_affordances
