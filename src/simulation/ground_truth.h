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

/// A stretch of a part, or of parts in a chain, that a hand can close around.
struct Affordance
{
  std::uint32_t label = 0;                     ///< 1..254
  std::string object;                          ///< name of the object that it belongs to
  double radius = 0.0;                         ///< m, of the surface where it is widest
  double length = 0.0;                         ///< m, along its axis
  double distance = 0.0;                       ///< m, from the camera to the middle of its axis
  std::vector<Eigen::Vector3d> axis;           ///< m, points along its axis, in the scene's frame
  std::vector<double> radii;                   ///< m, of the surface at these points: half the section's larger size
  std::optional<Eigen::Vector3d> ball_center;  ///< m, of what can be gripped about any axis: see Grip
  std::size_t visible_points = 0;              ///< measured in the frame
  double occluded_share = 0.0;  ///< of the pixels that it would fill alone, those where something is in front;
                                ///< 0 where it fills none
};

/// Labels that follow from the geometry alone.
struct GroundTruth
{
  std::vector<Affordance> affordances;  ///< by label, those that the frame does not show included
  std::vector<std::uint32_t> labels;    ///< per pixel of the frame; 0 where nothing was measured
};

/// Judges every part of a scene by the definition, per 4 mm of its axis, and labels what a frame shows of it.
///
/// Clearance is that of the exact geometry, all around: stricter than the paper's, whose annotator saw one side. Within
/// a margin of a threshold a stretch is doubtful, the margin being 1 mm or the sensor's depth quantum at that range,
/// whichever is larger; so is a slim bar whose section fits into the hand but is rectangular or too flat.
///
/// @param frame captured by a sensor of that model from the view
/// @param other_cameras  poses in the scene of more sensors of that model: the margin is then the largest of all, so
/// that an affordance of one view has the same label in each
/// @throw std::length_error for a scene with more than 254 affordances
GroundTruth groundTruth(const View& view, const Frame& frame, const XtionModel& model,
                        const GraspDefinition& definition = GraspDefinition(),
                        const std::vector<Eigen::Isometry3d>& other_cameras = {});

}  // namespace grasp_affordances
