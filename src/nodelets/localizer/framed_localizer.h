#pragma once

#include "grasp_affordances/RegionOfInterest.h"
#include "grasp_affordances/cloud.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"
#include "grasp_affordances/localizer.h"
#include "nodelets/localizer/handle_tracking.h"
#include "nodelets/parameters/parameters_ros.h"
#include "nodelets/roscpp/transforms.h"

#include <geometry_msgs/PointStamped.h>
#include <std_msgs/Header.h>
#include <Eigen/Geometry>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// A localizer, and the frames that a node's parameters name: what each thread of a node localizes with. Of one thread.
class FramedLocalizer
{
public:
  /// Everything that is needed from tf for the clouds of one moment.
  struct Frames
  {
    std::vector<Eigen::Isometry3d> T_common_cloud;              ///< of each cloud
    std::vector<std::optional<Eigen::Vector3f>> sensor_origin;  ///< of each cloud, m, in its frame; empty: not known
    Eigen::Isometry3d T_workspace_common = Eigen::Isometry3d::Identity();
    Eigen::Isometry3d T_approach_common = Eigen::Isometry3d::Identity();
    Eigen::Isometry3d T_output_common = Eigen::Isometry3d::Identity();
    FixedFrame fixed;             ///< as seen from the frame of the outputs
    std::string workspace_frame;  ///< that the box of the parameters or of the region is in
  };

  /// @param parameters, transforms  must outlive it
  /// @param cancelled  see Localizer::cancelWhen()
  /// @throw ParameterError for a config outside its range
  FramedLocalizer(const NodeParameters& parameters, const Config& config, Transforms& transforms,
                  std::function<bool()> cancelled);

  /// Looks all frames up, before any work is done, and waits for them no longer than one deadline: `transform_timeout`
  /// from now or, where a call names a region or a sensor, 1 s at least, since that may be the first to need any
  /// transform.
  /// @param common  frame that the clouds are brought into, and the time of the other transforms
  /// @param clouds  header of each cloud
  /// @param sensor  place of the clouds' sensor; without a frame: the origin of the parameters' `sensor_frame`. The
  /// transform is that at the stamp of the cloud
  /// @throw tf2::TransformException, which names the frames, where one is missing
  /// @throw std::invalid_argument for a sensor whose place is not finite, or has no frame
  Frames lookUp(const std_msgs::Header& common, const std::vector<std_msgs::Header>& clouds,
                const RegionOfInterest& region,
                const geometry_msgs::PointStamped& sensor = geometry_msgs::PointStamped());

  /// Localizes. The result, see localization(), is in the frame of the outputs.
  /// @param clouds  get their sensor's place from the frames
  /// @return the header of all outputs; its frame begins without a slash
  /// @throw Cancelled
  std_msgs::Header localize(const std::vector<Cloud*>& clouds, const std_msgs::Header& common, const Frames& frames,
                            const Config& config);

  /// Of the last cloud.
  const Localization& localization() const { return localization_; }

private:
  const NodeParameters& parameters_;
  Transforms& transforms_;
  Localizer localizer_;
  std::vector<PosedCloud> posed_clouds_;
  Localization localization_;
};

}  // namespace grasp_affordances
