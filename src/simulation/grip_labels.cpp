#include "simulation/grip_labels.h"

#include "simulation/chain_axes.h"
#include "simulation/surroundings.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr double kCellLength = 0.004;  ///< m, approximate
constexpr double kSlim = 1.2;          ///< a section with half sizes of this ratio or more has a slim side

enum class Verdict
{
  no,
  maybe,
  yes
};

struct CellEnd
{
  Eigen::Vector3d position;  ///< in the scene's frame
  double radius;             ///< see GripAxis::largestRadius()
};

/// A piece of a part's axis between two places.
struct Cell
{
  std::size_t part;
  std::size_t index;  ///< number within the part's cells, from the start of its axis
  double from, to;
  const GripAxis* axis;
  CellEnd first, last;  ///< in the order of the run
  double length;        ///< m, length that it adds to a run
  double margin;
  Verdict verdict;
};

using Run = std::vector<const Cell*>;

std::size_t cellCount(const GripAxis& axis)
{
  return static_cast<std::size_t>(std::max(1.0, std::round(axis.length() / kCellLength)));
}

/// Whether a value is below a threshold.
Verdict below(double value, double threshold, double margin)
{
  if (value < threshold - margin)
    return Verdict::yes;
  return value < threshold + margin ? Verdict::maybe : Verdict::no;
}

Verdict sectionFits(const Cell& cell, double capture_radius)
{
  const Eigen::Vector2d half_sizes = cell.axis->largestHalfSizes(cell.from, cell.to);
  const GripAxis::Section section = cell.axis->section();
  if (section == GripAxis::Section::rectangular)
    return std::min(below(half_sizes.norm(), capture_radius, cell.margin), Verdict::maybe);
  const double radius = cell.axis->largestRadius(cell.from, cell.to);
  if (section == GripAxis::Section::rounded || section == GripAxis::Section::oval)
    return below(radius, capture_radius, cell.margin);
  const double flat_side_radius = radius * radius / half_sizes.minCoeff();
  const Verdict flat_side = std::max(below(flat_side_radius, capture_radius, cell.margin), Verdict::maybe);
  return std::min(below(radius, capture_radius, cell.margin), flat_side);
}

/// Maximal runs of cells that have at least a given quality, and that are long enough.
std::vector<Run> runs(const std::vector<Cell>& cells, bool closed, Verdict least, double min_length)
{
  // On a closed axis the search starts at a cell that is not good enough, if there is one.
  std::size_t cut = 0;
  if (closed) {
    while (cut < cells.size() && cells[cut].verdict >= least)
      ++cut;
  }
  std::vector<Run> result(1);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& cell = cells[(cut + i) % cells.size()];
    if (cell.verdict >= least)
      result.back().push_back(&cell);
    else if (!result.back().empty())
      result.emplace_back();
  }
  const auto too_short = [&](const Run& run) {
    double length = 0.0, margin = 0.0;
    for (const Cell* cell : run) {
      length += cell->length;
      margin = std::max(margin, cell->margin);
    }
    return run.empty() || length < min_length + (least == Verdict::yes ? margin : -margin);
  };
  result.erase(std::remove_if(result.begin(), result.end(), too_short), result.end());
  return result;
}

bool isBall(const GripAxis& axis)
{
  constexpr double kMostTaper = 0.5, kMostSlender = 1.5;
  const double widest = axis.largestHalfSizes(0.0, axis.length()).maxCoeff();
  const double at_ends = std::max(axis.halfSizes(0.0).maxCoeff(), axis.halfSizes(axis.length()).maxCoeff());
  return at_ends < kMostTaper * widest && axis.length() <= kMostSlender * 2.0 * widest;
}

Grip gripOf(const Scene& scene, const Run& run)
{
  Grip grip;
  const auto append = [&grip](const CellEnd& end) {
    grip.axis.push_back(end.position);
    grip.radii.push_back(end.radius);
  };
  for (const Cell* cell : run) {
    if (grip.parts.empty() || grip.parts.back() != cell->part)
      grip.parts.push_back(cell->part);
    grip.radius = std::max(grip.radius, cell->axis->largestRadius(cell->from, cell->to));
    grip.length += cell->length;
    if (grip.axis.empty())
      append(cell->first);
    if (cell->length > 0.0)
      append(cell->last);
  }
  const GripAxis& axis = *run.front()->axis;
  if (grip.parts.size() == 1 && isBall(axis)) {
    const Eigen::Isometry3d& T_scene_shape = scene.parts()[grip.parts.front()].T_scene_shape;
    grip.ball_center = T_scene_shape * axis.sectionFrame(0.5 * axis.length()).translation();
  }
  return grip;
}

/// Runs that were found along an axis.
struct Found
{
  std::vector<Run> grips;
  std::vector<Run> doubtful;  ///< may contain cells of grips
};

/// Searches for grips along the axes of consecutive parts.
class GripSearch
{
public:
  GripSearch(const Scene& scene, const GraspDefinition& definition, const MarginAt& margin,
             const std::vector<Eigen::Vector3d>& cameras)
      : scene_(scene), definition_(definition), margin_(margin), cameras_(cameras), surroundings_(scene)
  {
  }

  std::vector<Cell> cells(const std::vector<PartAxis>& axes) const
  {
    std::vector<Cell> result;
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const PartAxis& along = axes[k];
      const std::size_t count = cellCount(along.axis);
      const double length = along.axis.length() / static_cast<double>(count);
      for (std::size_t i = 0; i < count; ++i) {
        Cell cell{};
        cell.part = along.part;
        cell.index = along.reversed ? count - 1 - i : i;
        cell.from = static_cast<double>(cell.index) * length;
        cell.to = static_cast<double>(cell.index + 1) * length;
        cell.axis = &along.axis;
        cell.first = endAt(along, along.reversed ? cell.to : cell.from);
        cell.last = endAt(along, along.reversed ? cell.from : cell.to);
        const Eigen::Vector3d middle = onAxis(along, 0.5 * (cell.from + cell.to));
        cell.length = insideEarlier(axes, k, middle) ? 0.0 : length;
        cell.margin = margin_(middle);
        cell.verdict = sectionFits(cell, definition_.capture_radius);
        if (allSeeSlimSide(cell))
          cell.verdict = std::min(cell.verdict, Verdict::maybe);
        result.push_back(cell);
      }
    }
    return result;
  }

  Found find(std::vector<Cell>& cells, const std::vector<PartAxis>& axes) const
  {
    const bool closed = axes.size() == 1 && axes.front().axis.closed();
    std::vector<std::size_t> chain;
    for (const PartAxis& axis : axes)
      chain.push_back(axis.part);

    // Clearance takes long to compute: only for cells that may meet the rest of the definition.
    std::vector<bool> candidate(cells.size(), false);
    for (const Run& run : runs(cells, closed, Verdict::maybe, definition_.min_length)) {
      for (const Cell* cell : run)
        candidate[static_cast<std::size_t>(cell - cells.data())] = true;
    }
    for (std::size_t i = 0; i < cells.size(); ++i)
      cells[i].verdict = candidate[i] ? std::min(cells[i].verdict, surroundingsAllow(cells[i], chain)) : Verdict::no;
    return {runs(cells, closed, Verdict::yes, definition_.min_length),
            runs(cells, closed, Verdict::maybe, definition_.min_length)};
  }

private:
  Eigen::Vector3d onAxis(const PartAxis& along, double place) const
  {
    return scene_.parts()[along.part].T_scene_shape * along.axis.sectionFrame(place).translation();
  }

  CellEnd endAt(const PartAxis& along, double place) const
  {
    return {onAxis(along, place), along.axis.largestRadius(place, place)};
  }

  bool insideEarlier(const std::vector<PartAxis>& axes, std::size_t k, const Eigen::Vector3d& point) const
  {
    return std::any_of(axes.begin(), axes.begin() + static_cast<std::ptrdiff_t>(k), [&](const PartAxis& earlier) {
      const Part& part = scene_.parts()[earlier.part];
      return contains(part.shape, part.T_scene_shape.inverse() * point);
    });
  }

  /// Whether no camera sees how long a rounded or oval section is, because it looks along it.
  bool allSeeSlimSide(const Cell& cell) const
  {
    const GripAxis::Section section = cell.axis->section();
    if (cameras_.empty() || !(section == GripAxis::Section::rounded || section == GripAxis::Section::oval))
      return false;
    const double middle = 0.5 * (cell.from + cell.to);
    const Eigen::Vector2d half_sizes = cell.axis->halfSizes(middle);
    const double longer = half_sizes.maxCoeff(), shorter = half_sizes.minCoeff();
    if (longer - shorter < cell.margin || longer < kSlim * shorter)
      return false;
    const Eigen::Isometry3d T_section_scene =
        (scene_.parts()[cell.part].T_scene_shape * cell.axis->sectionFrame(middle)).inverse();
    const bool long_x = half_sizes.x() > half_sizes.y();
    return std::all_of(cameras_.begin(), cameras_.end(), [&](const Eigen::Vector3d& camera) {
      const Eigen::Vector3d towards = (T_section_scene * camera).cwiseAbs();
      return long_x == (towards.x() > towards.y());
    });
  }

  /// In the background nobody looks for clearance, and nothing is certain.
  Verdict surroundingsAllow(const Cell& cell, const std::vector<std::size_t>& chain) const
  {
    const bool background = scene_.roles()[scene_.parts()[cell.part].object] == Role::background;
    return background ? Verdict::maybe : isClear(cell, chain);
  }

  Verdict isClear(const Cell& cell, const std::vector<std::size_t>& chain) const
  {
    const double enough = definition_.clearance + cell.margin;
    const double clearance = surroundings_.clearance(cell.part, *cell.axis, cell.from, cell.to, chain, enough);
    if (clearance >= enough)
      return Verdict::yes;
    return clearance >= definition_.clearance - cell.margin ? Verdict::maybe : Verdict::no;
  }

  const Scene& scene_;
  const GraspDefinition& definition_;
  const MarginAt& margin_;
  const std::vector<Eigen::Vector3d>& cameras_;
  Surroundings surroundings_;
};

}  // namespace

GripLabels::GripLabels(const Scene& scene, const GraspDefinition& definition, const MarginAt& margin,
                       const std::vector<Eigen::Vector3d>& cameras)
    : parts_(scene.parts().size())
{
  const GripSearch search(scene, definition, margin, cameras);
  for (std::size_t part = 0; part < scene.parts().size(); ++part) {
    const std::vector<std::vector<PartAxis>> choices = axisAlternatives(scene, part);
    std::vector<std::vector<Cell>> cells(choices.size());
    std::vector<Found> found;
    for (std::size_t i = 0; i < choices.size(); ++i) {
      cells[i] = search.cells(choices[i]);
      found.push_back(search.find(cells[i], choices[i]));
    }
    auto best = std::find_if(found.begin(), found.end(), [](const Found& f) { return !f.grips.empty(); });
    if (best == found.end())
      best = std::find_if(found.begin(), found.end(), [](const Found& f) { return !f.doubtful.empty(); });
    if (best == found.end())
      continue;

    for (const PartAxis& along : choices[static_cast<std::size_t>(best - found.begin())])
      parts_[along.part] = Cells{along.axis, std::vector<std::uint32_t>(cellCount(along.axis), kNotGraspable)};
    const auto mark = [this](const Run& run, std::uint32_t label) {
      for (const Cell* cell : run)
        parts_[cell->part]->labels[cell->index] = label;
    };
    for (const Run& run : best->doubtful)
      mark(run, kDoubtful);
    for (const Run& run : best->grips) {
      Grip grip = gripOf(scene, run);
      grip.label = static_cast<std::uint32_t>(grips_.size() + 1);
      if (grip.label == kDoubtful)
        throw std::length_error("a scene with more than 254 affordances");
      mark(run, grip.label);
      grips_.push_back(std::move(grip));
    }
  }
}

std::uint32_t GripLabels::label(std::size_t part, const Eigen::Vector3d& point_shape) const
{
  if (!parts_[part])
    return kNotGraspable;
  const auto& [axis, labels] = *parts_[part];
  const double share = axis.nearest(point_shape) / axis.length();
  return labels[std::min(static_cast<std::size_t>(share * static_cast<double>(labels.size())), labels.size() - 1)];
}

}  // namespace grasp_affordances
