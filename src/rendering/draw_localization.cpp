#include "rendering/picture.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace grasp_affordances
{
namespace
{

constexpr std::array<Color, 6> kPalette{{{1.00F, 0.62F, 0.05F},
                                         {0.15F, 0.85F, 0.95F},
                                         {0.60F, 0.95F, 0.20F},
                                         {1.00F, 0.35F, 0.65F},
                                         {0.70F, 0.55F, 1.00F},
                                         {1.00F, 0.95F, 0.30F}}};
constexpr Color kOfNoHandle{0.75F, 0.75F, 0.75F};
constexpr double kArrowLength = 0.03;      // m
constexpr std::size_t kMostHandPoses = 8;  // drawn per handle

Color colorOf(const GraspHandle& handle)
{
  return kPalette[(handle.id + kPalette.size() - 1) % kPalette.size()];
}

/// Draws shells. The more there are, the fainter each is drawn.
void drawShells(Picture& picture, const std::vector<Shell>& shells, const std::vector<std::uint32_t>& indices,
                const Color& color)
{
  ShellStyle faint;
  faint.color = color;
  faint.line_opacity = std::clamp(0.5 / std::sqrt(static_cast<double>(indices.size() + 1)), 0.04, 0.3);
  faint.fill_opacity = 0.1 * faint.line_opacity;
  faint.line_width = 1.0;
  faint.gap = false;
  for (const std::uint32_t i : indices) {
    picture.drawShell(shells[i], faint);
  }
}

std::vector<std::uint32_t> shellsOfNoHandle(const Localization& localization)
{
  std::vector<bool> has_handle(localization.shells.size(), false);
  for (const GraspHandle& handle : localization.handles) {
    for (const std::uint32_t i : handle.shells) {
      has_handle[i] = true;
    }
  }
  std::vector<std::uint32_t> rest;
  for (std::uint32_t i = 0; i < has_handle.size(); ++i) {
    if (!has_handle[i]) {
      rest.push_back(i);
    }
  }
  return rest;
}

/// Corners of a box in the hand's frame: x along the approach, y from thumb to fingers, z along the axis.
std::vector<Eigen::Vector3d> box(const Eigen::Isometry3d& hand, const Eigen::Vector3d& min, const Eigen::Vector3d& max)
{
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back(hand * Eigen::Vector3d((i & 1) != 0 ? max.x() : min.x(), (i & 2) != 0 ? max.y() : min.y(),
                                             (i & 4) != 0 ? max.z() : min.z()));
  }
  return corners;
}

Color lightened(const Color& color)
{
  return {0.5F + 0.5F * color.r, 0.5F + 0.5F * color.g, 0.5F + 0.5F * color.b};
}

/// Draws palm, finger and thumb of an open hand. Along the axis they are as wide as the fingers. The palm is almost
/// transparent, because it covers the handle if the hand approaches from the sensor's side.
void drawHand(Picture& picture, const GraspPose& grasp, const Config& config, const Color& color)
{
  const HandGeometry& geometry = config.hand;
  const Eigen::Isometry3d pose = poseOfHand(grasp, config.hand_poses);
  const double reach = 0.5 * grasp.width, thickness = geometry.finger_thickness, half_width = 0.5 * geometry.palm_width;
  BodyStyle style;
  style.color = lightened(color);
  style.line_width = 2.5;
  style.fill_opacity = 0.5;
  for (const double y : {-reach - thickness, reach}) {
    picture.drawHull(box(pose, {-reach, y, -half_width}, {reach, y + thickness, half_width}), style);
  }
  style.fill_opacity = 0.12;
  picture.drawHull(
      box(pose, {-reach - thickness, -reach - thickness, -half_width}, {-reach, reach + thickness, half_width}), style);
}

void drawApproach(Picture& picture, const GraspPose& grasp, const Config& config, const Color& color)
{
  BodyStyle faint;
  faint.color = color;
  faint.line_opacity = 0.45;
  faint.line_width = 2.0;
  const Eigen::Isometry3d pose = poseOfHand(grasp, config.hand_poses);
  const Eigen::Vector3d approach = pose.linear().col(0);
  const Eigen::Vector3d end = pose.translation() - 0.5 * grasp.width * approach;
  picture.drawArrow(end - kArrowLength * approach, end, faint);
}

void drawHandle(Picture& picture, const GraspHandle& handle)
{
  BodyStyle bold;
  bold.color = colorOf(handle);
  picture.drawTube(handle.polyline, handle.radius, bold);
}

}  // namespace

void drawLocalization(Picture& picture, const Localization& localization, const Config& config)
{
  const std::vector<GraspHandle>& handles = localization.handles;
  const std::vector<Shell>& shells = localization.shells;
  drawShells(picture, shells, shellsOfNoHandle(localization), kOfNoHandle);
  for (const GraspHandle& handle : handles) {
    drawShells(picture, shells, handle.shells, colorOf(handle));
  }
  for (const GraspHandle& handle : handles) {
    drawHandle(picture, handle);
  }
  for (const GraspHandle& handle : handles) {
    const auto& grasps = handle.hand_poses;
    for (std::size_t i = 1; i < std::min(grasps.size(), kMostHandPoses); ++i) {
      drawApproach(picture, grasps[i], config, colorOf(handle));
    }
    if (!grasps.empty()) {
      drawHand(picture, grasps.front(), config, colorOf(handle));
    }
  }
  for (const GraspHandle& handle : handles) {
    picture.drawLabel(std::to_string(handle.id), handle.polyline, handle.radius, colorOf(handle));
  }
}

}  // namespace grasp_affordances
