#pragma once

#include "grasp_affordances/cloud.h"

#include "core/cloud/padding.h"
#include "core/cloud/range_image.h"
#include "core/cloud/reprojection.h"
#include "core/parallel/thread_team.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// What can be used of a cloud: all of it as a rule. Two kinds of points are left out, as if they had not been
/// measured: padding, and the few points of a range image that are not on their pixel's ray. Then a copy of the cloud
/// is used. A range image without such points is neither searched for them nor copied. Keeps its memory from cloud to
/// cloud.
class UsableCloud
{
public:
  /// Largest share of the measured points that are left out so that the others are a range image. Filters that change
  /// only z put some 0.1 % off their rays.
  static constexpr double kMostStrays = 0.01;

  UsableCloud() = default;
  UsableCloud(const UsableCloud&) = delete;
  UsableCloud& operator=(const UsableCloud&) = delete;

  /// Looks at another cloud. It must stay as it is for as long as it is used.
  /// @param team  does the work, without influence on the result; null: the caller's thread does it
  void update(const Cloud& cloud, ThreadTeam* team = nullptr);

  /// The cloud, or the copy without the points that are left out. Points keep their indices.
  const Cloud& cloud() const { return *cloud_; }

  /// How many measured points are left out.
  std::size_t leftOut() const { return left_out_; }

  /// The range image of cloud(), where that is one.
  const std::optional<RangeImage>& image() const { return image_; }

  /// Why there is no range image; empty where there is one.
  const std::string& whyNoImage() const { return why_no_image_; }

  /// What was left out or replaced, and why: one line each.
  const std::vector<std::string>& warnings() const { return warnings_; }

private:
  void createImage(ThreadTeam* team);
  void leaveOutPadding(const Cloud& cloud);
  void leaveOutStrays(const Cloud& cloud, ThreadTeam* team);
  bool leaveOutStraysFrom(const PinholeIntrinsics& intrinsics, const PixelSample& sample);
  void takeBackStrays(const Cloud& cloud);
  void leaveOut(const std::vector<std::uint32_t>& points);

  const Cloud* cloud_ = nullptr;
  std::optional<RangeImage> image_;
  std::string why_no_image_;
  std::vector<std::string> warnings_;
  std::size_t left_out_ = 0;
  Misfit stray_reason_ = Misfit::bad_points;
  Padding padding_;
  std::vector<std::uint32_t> strays_;
  Cloud copy_;
};

}  // namespace grasp_affordances
