// draw_hand_frame FILE.png: draws the frame of a hand pose at an upright bar, for docs/images/hand_frame.png.

#include "grasp_affordances/config.h"
#include "grasp_affordances/handle.h"
#include "grasp_affordances/localization.h"
#include "rendering/picture.h"
#include "simulation/placement.h"
#include "simulation/scene.h"
#include "simulation/sensor.h"

#include <Eigen/Geometry>

#include <exception>
#include <iostream>
#include <string>

namespace grasp_affordances
{
namespace
{

constexpr double kRadius = 0.014, kHeight = 0.22;  // m, of the bar
constexpr double kGraspHeight = 0.1;               // m above the table

/// An upright bar on a table, seen from behind and above the hand's right-hand side. The scene's axes are those of the
/// hand: x along the approach, z along the bar.
View barOnTable()
{
  View view;
  view.scene.beginObject("table");
  view.scene.add(Box{{0.5, 0.5, 0.02}}, upright(0.0, 0.0, 0.0) * Eigen::Translation3d(0.0, 0.0, -0.01));
  view.scene.beginObject("bar");
  view.scene.add(Cylinder{kRadius, kHeight}, upright(0.0, 0.0, 0.0) * Eigen::Translation3d(0.0, 0.0, 0.5 * kHeight));
  const Eigen::Vector3d target(0.0, 0.0, kGraspHeight);
  view.T_scene_camera = lookAt(target + Eigen::Vector3d(-0.13, -0.24, 0.16), target);
  return view;
}

/// The handle that the bar is, with one hand pose, in the camera's frame.
Localization localizationOfBar(const Eigen::Isometry3d& T_camera_hand)
{
  const Eigen::Isometry3d& T = T_camera_hand;
  GraspHandle handle;
  handle.id = 1;
  handle.centroid = T.translation();
  handle.axis = T.linear().col(2);
  handle.normal = -T.linear().col(0);
  handle.radius = kRadius;
  handle.inner_radius = kRadius + 0.004;
  handle.length = 2.0 * kGraspHeight;
  const Eigen::Vector3d half = 0.5 * handle.length * handle.axis;
  handle.polyline = {handle.centroid - half, handle.centroid + half};
  GraspPose grasp;
  grasp.pose = T;
  grasp.width = 2.0 * handle.inner_radius;
  handle.hand_poses = {grasp};
  Localization localization;
  localization.handles = {handle};
  return localization;
}

void drawArrow(Picture& picture, const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Color& color)
{
  BodyStyle style;
  style.color = color;
  style.line_width = 7.0;
  picture.drawArrow(from, to, style);
}

void drawAxis(Picture& picture, const Eigen::Isometry3d& frame, const Eigen::Vector3d& tip, const Color& color,
              const std::string& label)
{
  drawArrow(picture, frame.translation(), frame * tip, color);
  constexpr double kBeside = 0.002;  // m
  picture.drawLabel(label, {frame * tip, frame * (1.02 * tip)}, kBeside, color);
}

/// The way of the hand to where it closes.
void drawApproach(Picture& picture, const Eigen::Isometry3d& frame)
{
  const Color white{1.0F, 1.0F, 1.0F};
  const Eigen::Vector3d from = frame * Eigen::Vector3d(-0.11, 0.0, 0.0), to = frame * Eigen::Vector3d(-0.04, 0.0, 0.0);
  drawArrow(picture, from, to, white);
  picture.drawLabel("hand", {from, to}, 0.002, white);
}

void draw(const std::string& path)
{
  SensorModel model;
  model.exact = true;
  model.min_depth = 0.05;
  const View view = barOnTable();
  const Frame frame = DepthCamera(model).capture(view.scene, view.T_scene_camera, 1);
  const Eigen::Isometry3d T_camera_hand = view.T_scene_camera.inverse() * Eigen::Translation3d(0.0, 0.0, kGraspHeight);

  Picture picture(frame.cloud);
  drawLocalization(picture, localizationOfBar(T_camera_hand), Config());
  drawApproach(picture, T_camera_hand);
  drawAxis(picture, T_camera_hand, {0.08, 0.0, 0.0}, {1.0F, 0.25F, 0.2F}, "x: approach");
  drawAxis(picture, T_camera_hand, {0.0, 0.09, 0.0}, {0.3F, 0.9F, 0.3F}, "y: fingers oppose");
  drawAxis(picture, T_camera_hand, {0.0, 0.0, 0.08}, {0.35F, 0.6F, 1.0F}, "z: handle's axis");
  picture.drawCaption("Frame of a hand pose: the origin is on the axis of the handle, between the open fingers");
  picture.save(path);
}

}  // namespace
}  // namespace grasp_affordances

int main(int argc, char** argv)
{
  if (argc != 2) {
    std::cerr << "usage: draw_hand_frame FILE.png\n";
    return 2;
  }
  try {
    grasp_affordances::draw(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
