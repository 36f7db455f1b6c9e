#pragma once

#include "grasp_affordances/config.h"
#include "grasp_affordances/handle.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>

namespace grasp_affordances
{

/// Which of a handle's hand poses somebody has chosen. From cloud to cloud poses change their places in the list, as
/// their scores do, and now and then one is missing: the choice is remembered as a direction of approach and a place
/// along the handle, and followed. Of one thread.
class HandPoseChoice
{
public:
  /// Forgets the choice: the next one is the best pose.
  void reset() { wanted_.reset(); }

  /// Index of the chosen pose in handle.hand_poses, nothing where there are none. Without a choice it is the first, and
  /// that is chosen. A pose that is missing is replaced by the nearest one until it is back.
  /// @param handle  in the frame of the handle before it, or one that has hardly moved against it
  std::optional<std::size_t> follow(const GraspHandle& handle, const Eigen::Isometry3d& T_hand_tool);

  /// Chooses another pose: the next one around the axis, counter-clockwise as seen against it, or with `backwards` the
  /// previous one. Poses with one direction of approach follow one another along the axis.
  std::optional<std::size_t> step(const GraspHandle& handle, const Eigen::Isometry3d& T_hand_tool, bool backwards);

private:
  struct Place
  {
    Eigen::Vector3d approach;  // unit
    Eigen::Vector3d axis;      // the handle's, unit
    double along = 0.0;        // m, from the handle's centroid along the axis
  };

  static Place place(const GraspHandle& handle, std::size_t index, const Eigen::Isometry3d& T_hand_tool);

  std::optional<Place> wanted_;
};

}  // namespace grasp_affordances
