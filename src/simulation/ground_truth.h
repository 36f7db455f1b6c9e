#pragma once

#include "simulation/grasp_definition.h"
#include "simulation/scene.h"
#include "simulation/sensor.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// A section of a part, or of several parts of a chain, that a hand can close around.
struct Affordance
{
  std::uint32_t label = 0;                     ///< 1..254
  std::string object;                          ///< name of the object that it belongs to
  double radius = 0.0;                         ///< m, largest radius of the surface
  double length = 0.0;                         ///< m, along its axis
  double distance = 0.0;                       ///< m, from the camera to the middle of its axis
  std::vector<Eigen::Vector3d> axis;           ///< m, points along its axis, in the scene's frame
  std::vector<double> radii;                   ///< m, of the surface at these points: half the section's larger size
  std::optional<Eigen::Vector3d> ball_center;  ///< m, centre of a ball, see Grip
  std::size_t visible_points = 0;              ///< measured in the frame
  double occluded_share = 0.0;  ///< share of the pixels that it would fill alone in which something is in front of
                                ///< it; 0 if it fills no pixel
};

/// Labels of a frame. They follow from the geometry alone.
struct GroundTruth
{
  std::vector<Affordance> affordances;  ///< in the order of labels; includes those that the frame does not show
  std::vector<std::uint32_t> labels;    ///< per pixel of the frame; 0 where nothing was measured
};

/// Applies the definition to every 4 mm of the axis of every part of a scene, and labels the pixels of a frame.
///
/// Clearance is measured all around, in the exact geometry. This is stricter than in the paper, whose annotator saw one
/// side. A section is doubtful if a quantity differs from its threshold by less than a margin. The margin is the larger
/// one of 1 mm and the sensor's depth quantum at that range. A slim bar is doubtful, too, if its cross-section fits
/// into the hand but is rectangular or too flat; a rounded or oval one, if every camera looks at its slim side.
///
/// @param frame captured by a sensor of that model from the view
/// @param other_cameras  poses in the scene of further sensors of that model. The margin is the largest one of all
/// sensors, so that an affordance has the same label in all views
/// @throw std::length_error for a scene with more than 254 affordances
GroundTruth groundTruth(const View& view, const Frame& frame, const SensorModel& model,
                        const GraspDefinition& definition = GraspDefinition(),
                        const std::vector<Eigen::Isometry3d>& other_cameras = {});

}  // namespace grasp_affordances
