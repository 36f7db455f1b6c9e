#include "core/handles/handle_axis.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace grasp_affordances
{
namespace
{

/// The share of the shells that may be away from a straight axis, or end before it does.
constexpr double kStray = 0.1;

/// The value that all but a share kStray of the values reach. Sorts the values.
double reachedByMost(std::vector<double>& values)
{
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(kStray * static_cast<double>(values.size()))];
}

/// A direction or its opposite, whichever is in the half-space of the reference.
Eigen::Vector3d turnedTowards(const Eigen::Vector3d& reference, const Eigen::Vector3d& direction)
{
  return direction.dot(reference) < 0.0 ? Eigen::Vector3d(-direction) : direction;
}

/// The direction that the shells' axes have in common, without regard to their signs.
/// @param concentration  out: the mean square of the cosines between this direction and the axes
Eigen::Vector3d commonDirection(const std::vector<const Shell*>& shells, double& concentration)
{
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (const Shell* shell : shells) {
    products += shell->axis * shell->axis.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(products / static_cast<double>(shells.size()));
  concentration = solver.eigenvalues()[2];
  return withLargestComponentPositive(solver.eigenvectors().col(2));
}

}  // namespace

void AxisTracer::Node::add(const Shell& shell)
{
  shells += 1.0;
  places += shell.centroid;
  directions += turnedTowards(directions, shell.axis);
  half_lengths += shell.length / 2;
}

void AxisTracer::trace(const std::vector<const Shell*>& shells, SharedAxis& axis)
{
  axis.polyline.clear();
  axis.round = false;
  if (traceLine(shells, axis)) {
    return;
  }
  makeNodes(shells);
  joinNodes();
  followPath(axis);
}

/// Sets the axis to a line where the shells have one.
/// @return whether they have
bool AxisTracer::traceLine(const std::vector<const Shell*>& shells, SharedAxis& axis)
{
  double concentration = 0.0;
  const Eigen::Vector3d direction = commonDirection(shells, concentration);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double radius = 0.0;
  for (const Shell* shell : shells) {
    middle += shell->centroid;
    radius += shell->inner_radius;
  }
  middle /= static_cast<double>(shells.size());
  radius /= static_cast<double>(shells.size());

  constexpr double kLargestAngle = 0.3;     // rad
  constexpr double kLargestOffset = 0.006;  // m
  std::size_t strays = 0;
  double spread = 0.0;
  for (const Shell* shell : shells) {
    const Eigen::Vector3d offset = shell->centroid - middle;
    const bool off = (offset - offset.dot(direction) * direction).norm() > kLargestOffset ||
                     std::abs(shell->axis.dot(direction)) < std::cos(kLargestAngle);
    strays += off ? 1 : 0;
    spread += offset.squaredNorm();
  }
  spread = std::sqrt(spread / static_cast<double>(shells.size()));
  constexpr double kRound = 0.8;
  axis.round = concentration < kRound && spread < 0.5 * radius;
  if (!axis.round && static_cast<double>(strays) > kStray * static_cast<double>(shells.size())) {
    return false;
  }
  const auto end = [&](double sign) {
    ends_.clear();
    for (const Shell* shell : shells) {
      ends_.push_back(-(sign * (shell->centroid - middle).dot(direction) + shell->length / 2));
    }
    return -reachedByMost(ends_);
  };
  const double first = end(-1.0), last = end(1.0);
  axis.polyline = {middle - first * direction, middle + last * direction};
  return true;
}

void AxisTracer::makeNodes(const std::vector<const Shell*>& shells)
{
  constexpr double kSpacing = 0.008;  // m
  nodes_.clear();
  for (const Shell* shell : shells) {
    const auto near = std::find_if(nodes_.begin(), nodes_.end(), [&](const Node& node) {
      return (node.place() - shell->centroid).norm() < kSpacing;
    });
    if (near == nodes_.end()) {
      nodes_.emplace_back().add(*shell);
    } else {
      near->add(*shell);
    }
  }
}

/// Joins the nodes to a tree of least total length, by Prim's algorithm.
void AxisTracer::joinNodes()
{
  const std::size_t count = nodes_.size();
  neighbours_.resize(std::max(neighbours_.size(), count));
  for (auto& neighbours : neighbours_) {
    neighbours.clear();
  }
  parents_.assign(count, 0);
  distances_.assign(count, std::numeric_limits<double>::infinity());
  open_.clear();
  for (std::size_t i = 1; i < count; ++i) {
    open_.push_back(i);
  }
  for (std::size_t newest = 0; !open_.empty();) {
    for (const std::size_t i : open_) {
      const double distance = (nodes_[i].place() - nodes_[newest].place()).norm();
      if (distance < distances_[i]) {
        distances_[i] = distance;
        parents_[i] = newest;
      }
    }
    const auto nearest = std::min_element(open_.begin(), open_.end(),
                                          [&](std::size_t a, std::size_t b) { return distances_[a] < distances_[b]; });
    newest = *nearest;
    open_.erase(nearest);
    neighbours_[newest].push_back(parents_[newest]);
    neighbours_[parents_[newest]].push_back(newest);
  }
}

/// The node that is farthest from another one along the tree. Sets the node before each node on the way (before_).
std::size_t AxisTracer::farthestFrom(std::size_t start)
{
  distances_.assign(nodes_.size(), 0.0);
  before_.assign(nodes_.size(), start);
  open_.assign(1, start);
  std::size_t farthest = start;
  while (!open_.empty()) {
    const std::size_t node = open_.back();
    open_.pop_back();
    if (distances_[node] > distances_[farthest]) {
      farthest = node;
    }
    for (const std::size_t next : neighbours_[node]) {
      if (next != before_[node] && next != start) {
        before_[next] = node;
        distances_[next] = distances_[node] + (nodes_[next].place() - nodes_[node].place()).norm();
        open_.push_back(next);
      }
    }
  }
  return farthest;
}

void AxisTracer::followPath(SharedAxis& axis)
{
  const std::size_t first = farthestFrom(0), last = farthestFrom(first);
  path_.assign(1, last);
  while (path_.back() != first) {
    path_.push_back(before_[path_.back()]);
  }
  // Beyond the middle of the outermost shells the axis goes on by half their mean length.
  const auto prolonged = [&](std::size_t end, const Eigen::Vector3d& outwards) {
    const Node& node = nodes_[end];
    return Eigen::Vector3d(node.place() + node.half_lengths / node.shells * turnedTowards(outwards, node.direction()));
  };
  const auto place = [&](std::size_t i) { return nodes_[path_[i]].place(); };
  const std::size_t count = path_.size();
  axis.polyline.push_back(
      prolonged(path_.front(), count > 1 ? Eigen::Vector3d(place(0) - place(1)) : nodes_[path_.front()].direction()));
  for (std::size_t i = 0; i < count; ++i) {
    // A mean with the neighbors, since the places of nodes scatter across the axis.
    const bool inner = i > 0 && i + 1 < count;
    axis.polyline.push_back(inner ? Eigen::Vector3d(place(i) / 2 + (place(i - 1) + place(i + 1)) / 4) : place(i));
  }
  axis.polyline.push_back(prolonged(path_.back(), count > 1 ? Eigen::Vector3d(place(count - 1) - place(count - 2))
                                                            : Eigen::Vector3d(-nodes_[path_.back()].direction())));
}

}  // namespace grasp_affordances
