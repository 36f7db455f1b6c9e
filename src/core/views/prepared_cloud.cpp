#include "core/views/prepared_cloud.h"

#include "core/kernels/measured_kernels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <sstream>

namespace grasp_affordances
{
namespace
{

SphereView unseen(const Neighborhood& neighborhood)
{
  SphereSurvey survey{};
  survey.points = neighborhood.size();
  return {neighborhood.center, neighborhood.radius, PixelWindow{}, survey};
}

constexpr std::size_t kSomePoints = 256;  // which say where and how large a cloud is
using Numbers = std::array<float, kSomePoints>;

/// Of some points, evenly from the list of those measured: by coordinate.
std::array<Numbers, 3> someCoordinates(const Cloud& cloud, const std::vector<std::uint32_t>& measured)
{
  std::array<Numbers, 3> coordinates;
  for (std::size_t i = 0; i < kSomePoints; ++i) {
    const Eigen::Vector3f point = cloud.point(measured[i * measured.size() / kSomePoints]);
    for (std::size_t axis = 0; axis < coordinates.size(); ++axis) {
      coordinates[axis][i] = point[static_cast<Eigen::Index>(axis)];
    }
  }
  return coordinates;
}

Eigen::Vector3f middleOf(const std::array<Numbers, 3>& coordinates)
{
  Eigen::Vector3f middle;
  for (std::size_t axis = 0; axis < coordinates.size(); ++axis) {
    Numbers values = coordinates[axis];
    std::nth_element(values.begin(), values.begin() + kSomePoints / 2, values.end());
    middle[static_cast<Eigen::Index>(axis)] = values[kSomePoints / 2];
  }
  return middle;
}

/// What is left out without the sensor's place, and how to give it.
std::string sensorUnknown(const Config& config)
{
  return std::string("the place of the sensor is not known: ") +
         (config.estimation.reject_concave ? "concave surfaces are not rejected, " : "") +
         "normals are left out, and hands may approach from any side; give it by ~sensor_frame (a node with one "
         "camera), the field sensor (a call of ~localize), --viewpoint x,y,z (localize), VIEWPOINT (a PCD file) or "
         "Cloud::sensor_origin";
}

}  // namespace

std::string nothingToLocalize(NothingSampled reason)
{
  return std::string("nothing to localize: ") + describe(reason);
}

void PreparedCloud::update(const Cloud& new_cloud, const Config& config, const Eigen::Isometry3d& T_workspace_cloud,
                           ThreadTeam& team)
{
  cloud = &new_cloud;
  image.reset();
  search = nullptr;
  sensor.reset();
  warnings.clear();
  nothing_sampled.reset();
  screen.clear();
  hidden_search.reset();
  limited_ = false;
  listMeasured();
  if (measured.empty()) {
    leaveOut(cloud->size() == 0 ? NothingSampled::empty_cloud : NothingSampled::nothing_measured);
    return;
  }
  if (allCoincide()) {
    leaveOut(NothingSampled::points_coincide);
    return;
  }

  usable_.update(new_cloud, &team);
  warnings = usable_.warnings();
  if (usable_.leftOut() > 0) {
    cloud = &usable_.cloud();
    listMeasured();
    if (measured.empty()) {
      leaveOut(NothingSampled::points_coincide);
      return;
    }
  }
  findWorkspace(config.workspace, T_workspace_cloud, team);
  image = usable_.image();
  std::string warning = usable_.whyNoImage();
  if (image) {
    sensor = Eigen::Vector3d::Zero();
    search = &window_search_.emplace(*image, measured.size());
  } else {
    if (cloud->sensor_origin && cloud->sensor_origin->allFinite()) {
      sensor = cloud->sensor_origin->cast<double>();
    }
    tree_search_.update(*cloud, &team);
    search = &tree_search_;
    if (config.occlusion.filter || config.shell.require_observed_gap || config.sampling.screen ||
        config.shell.continue_surfaces || config.shell.min_coverage > 0.0) {
      warning +=
          "; without a range image occlusion and observed free space are not judged, nor is coverage; no surfaces "
          "are continued, and samples are drawn from all points";
    }
  }
  suspectUnit();
  suspectPrecision(config.hand.finger_thickness);
  if (!warning.empty()) {
    warnings.push_back(warning);
  }
  if (!sensor) {
    warnings.push_back(sensorUnknown(config));
  }
  if (image && config.sampling.screen) {
    screen.update(*image, config.hand, static_cast<std::size_t>(config.sampling.samples), config.sampling.seed, team,
                  limited_ ? is_within_.data() : nullptr);
  }
  if (image && config.shell.continue_surfaces) {
    constexpr double kWidestBridge = 8.0;  // capture radii: what a hand can grasp, and the shadow beside it
    hidden.update(*image, kWidestBridge * config.hand.capture_radius, team);
    hidden_image = image->withCloud(hidden.cloud());
    hidden_search.emplace(*hidden_image, 0);
  }
}

void PreparedCloud::leaveOut(NothingSampled reason)
{
  nothing_sampled = reason;
  warnings.push_back(nothingToLocalize(reason));
}

void PreparedCloud::listMeasured()
{
  measured.resize(countMeasured(cloud->x.data(), cloud->size()));
  grasp_affordances::listMeasured(cloud->x.data(), cloud->size(), measured.data(), measured.size());
}

bool PreparedCloud::allCoincide() const
{
  const Eigen::Vector3f first = cloud->point(measured.front());
  return std::all_of(measured.begin(), measured.end(), [&](std::uint32_t i) { return cloud->point(i) == first; });
}

/// Warns where nearly all points are so far from the sensor, or from their middle where its place is not known, that no
/// hand reaches them.
void PreparedCloud::suspectUnit()
{
  constexpr float kFar = 50.0F;  // m
  const std::array<Numbers, 3> coordinates = someCoordinates(*cloud, measured);
  const Eigen::Vector3f from = sensor ? Eigen::Vector3f(sensor->cast<float>()) : middleOf(coordinates);
  Numbers ranges;
  for (std::size_t i = 0; i < kSomePoints; ++i) {
    ranges[i] = (Eigen::Vector3f(coordinates[0][i], coordinates[1][i], coordinates[2][i]) - from).norm();
  }
  std::sort(ranges.begin(), ranges.end());
  if (ranges[ranges.size() / 20] > kFar) {
    std::ostringstream text;
    text.precision(3);
    text << "nearly all points are farther than " << kFar << " m from " << (sensor ? "the sensor" : "their middle")
         << ", half of them farther than " << ranges[ranges.size() / 2]
         << " m: coordinates must be in metres; are they in millimetres?";
    warnings.push_back(text.str());
  }
}

/// Warns where coordinates are too large for single precision to tell the width of a gap. With steps of a half of the
/// finger's thickness the handles of simulated tables are still found, with steps of all of it a third to a half are
/// not.
void PreparedCloud::suspectPrecision(double finger_thickness)
{
  constexpr double kShare = 0.1;
  const float farthest = middleOf(someCoordinates(*cloud, measured)).cwiseAbs().maxCoeff();
  const double step = static_cast<double>(std::nextafter(farthest, std::numeric_limits<float>::infinity())) - farthest;
  if (step > kShare * finger_thickness) {
    std::ostringstream text;
    text.precision(3);
    text << "coordinates of some " << farthest << " m have steps of " << 1e3 * step
         << " mm in single precision, and the finger is " << 1e3 * finger_thickness
         << " mm thick: move the cloud nearer to the origin, before it is stored in single precision";
    warnings.push_back(text.str());
  }
}

double PreparedCloud::spacing(double radius) const
{
  constexpr std::size_t kPoints = 15;
  std::array<std::size_t, kPoints> neighbors;
  Neighborhood neighborhood;
  for (std::size_t i = 0; i < kPoints; ++i) {
    search->withinRadius(cloud->point(measured[i * measured.size() / kPoints]), static_cast<float>(radius),
                         neighborhood);
    neighbors[i] = neighborhood.size();
  }
  std::sort(neighbors.begin(), neighbors.end());
  return radius * std::sqrt(M_PI / static_cast<double>(neighbors[kPoints / 2]));
}

void PreparedCloud::findWorkspace(const WorkspaceConfig& workspace, const Eigen::Isometry3d& T_workspace_cloud,
                                  ThreadTeam& team)
{
  limited_ = workspace.isLimit();
  if (!limited_) {
    return;
  }
  using Sides = Eigen::Array<bool, 3, 1>;
  const Eigen::Array3d lower(workspace.min_x, workspace.min_y, workspace.min_z);
  const Eigen::Array3d upper(workspace.max_x, workspace.max_y, workspace.max_z);
  const Sides open_below = !lower.unaryExpr([](double min) { return WorkspaceConfig::isLowerLimit(min); });
  const Sides open_above = !upper.unaryExpr([](double max) { return WorkspaceConfig::isUpperLimit(max); });
  is_within_.resize(cloud->size());
  const auto isWithin = [&](std::size_t i) {
    const Eigen::Array3d point = T_workspace_cloud * cloud->point(i).cast<double>();
    return ((point >= lower || open_below) && (point <= upper || open_above)).all();
  };
  constexpr std::size_t kBatch = 4096;
  team.forEach((cloud->size() + kBatch - 1) / kBatch, [&](std::size_t batch, std::size_t) {
    for (std::size_t i = batch * kBatch; i < std::min(cloud->size(), (batch + 1) * kBatch); ++i) {
      is_within_[i] = isWithin(i) ? 1 : 0;
    }
  });
  within_.clear();
  std::copy_if(measured.begin(), measured.end(), std::back_inserter(within_),
               [&](std::uint32_t i) { return is_within_[i] != 0; });
}

SphereView PreparedCloud::gather(const Eigen::Vector3f& center, float radius, bool with_index,
                                 Neighborhood& neighborhood) const
{
  if (const WindowSearch* window = windowSearch()) {
    return window->gather(center, radius, with_index, neighborhood);
  }
  search->withinRadius(center, radius, neighborhood);
  return unseen(neighborhood);
}

SphereView PreparedCloud::gatherNearest(const Eigen::Vector3f& center, std::size_t k, bool with_view,
                                        Neighborhood& neighborhood) const
{
  search->nearest(center, k, neighborhood);
  if (image && with_view) {
    return viewOf(neighborhood, *image);
  }
  return unseen(neighborhood);
}

}  // namespace grasp_affordances
