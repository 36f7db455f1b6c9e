#include "core/cloud/usable_cloud.h"

#include "core/kernels/measured_kernels.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace grasp_affordances
{
namespace
{

std::string placeText(const Eigen::Vector3f& place)
{
  std::ostringstream text;
  text << "(" << place.x() << ", " << place.y() << ", " << place.z() << ") m";
  return text.str();
}

std::string pointsText(std::size_t points)
{
  return std::to_string(points) + (points == 1 ? " point" : " points");
}

std::string paddingText(const Padding& padding)
{
  const std::size_t points = padding.points().size(), at_largest = padding.pointsAtLargestPlace();
  std::string text = pointsText(at_largest) + " coincide at " + placeText(padding.largestPlace());
  if (padding.places() > 1) {
    text += ", and " + pointsText(points - at_largest) + " at " + std::to_string(padding.places() - 1) + " other " +
            (padding.places() == 2 ? "place" : "places");
  }
  return text + ": padding, which is left out; write NaN where nothing was measured";
}

std::string straysText(std::size_t strays, std::size_t measured, Misfit reason)
{
  std::ostringstream text;
  text.precision(2);
  text << strays << " of " << pointsText(measured) << " ("
       << 100.0 * static_cast<double>(strays) / static_cast<double>(measured) << " %) "
       << (strays == 1 ? "misses its pixel" : "miss their pixels") << " by more than " << RangeImage::kMaxResidual
       << " pixels, or " << (strays == 1 ? "is" : "are") << " behind the sensor: left out"
       << (reason == Misfit::distorted ? "; the lens distortion was not removed (use the rectified image)" : "");
  return text.str();
}

std::string describe(Misfit misfit)
{
  const std::string miss = "the organized cloud's points miss their pixels: ";
  switch (misfit) {
    case Misfit::moved:
      return miss + "it was moved out of its optical frame";
    case Misfit::distorted:
      return miss + "the lens distortion was not removed (use the rectified image)";
    case Misfit::columns_first:
      return miss + "its columns are stored one after the other, not its rows";
    case Misfit::bad_points:
      return miss + "too many of them do, in no common way, to leave them out";
    case Misfit::too_few:
      return "the organized cloud has too few points to determine a projection onto its pixels";
    case Misfit::unexplained:
      break;
  }
  return miss + "it is not in its optical frame, or no camera measured it";
}

}  // namespace

void UsableCloud::update(const Cloud& cloud, ThreadTeam* team)
{
  cloud_ = &cloud;
  left_out_ = 0;
  warnings_.clear();
  createImage(team);
  if (image_) {
    return;
  }
  leaveOutPadding(cloud);
  if (left_out_ > 0) {
    createImage(team);
  }
  const bool may_be_image = cloud.organized() && std::max(cloud.width, cloud.height) <= RangeImage::kLongestSide;
  if (!image_ && may_be_image) {
    leaveOutStrays(cloud, team);
  }
}

/// Takes all points of the cloud for a range image's.
void UsableCloud::createImage(ThreadTeam* team)
{
  std::string warning;
  image_ = RangeImage::create(*cloud_, warning, team);
  why_no_image_ = image_ ? "" : warning;
  if (image_ && !warning.empty()) {
    warnings_.push_back(warning);
  }
}

void UsableCloud::leaveOutPadding(const Cloud& cloud)
{
  padding_.find(cloud);
  if (padding_.points().empty()) {
    return;
  }
  leaveOut(padding_.points());
  warnings_.push_back(paddingText(padding_));
}

/// Makes a range image of all points but a few, where there are no more.
void UsableCloud::leaveOutStrays(const Cloud& cloud, ThreadTeam* team)
{
  const std::size_t measured = countMeasured(cloud_->x.data(), cloud_->size());
  const PixelSample sample(*cloud_);
  strays_.clear();
  stray_reason_ = Misfit::bad_points;
  const std::optional<PinholeIntrinsics>& given = cloud.intrinsics;
  const bool given_fits = given && leaveOutStraysFrom(*given, sample);
  if (given_fits) {
    image_ = RangeImage::create(*cloud_, *given, team);
  }
  constexpr int kAttempts = 3;  // least squares move the intrinsics a little, and with them a few points over the bound
  std::optional<PinholeIntrinsics> estimated = robustIntrinsics(*cloud_, sample);
  for (int i = 0; i < kAttempts && !image_ && estimated; ++i) {
    takeBackStrays(cloud);
    if (!leaveOutStraysFrom(*estimated, sample)) {
      break;
    }
    const auto fit = estimateIntrinsics(*cloud_, team);
    estimated = fit ? std::make_optional(fit->intrinsics) : std::nullopt;
    if (estimated) {
      image_ = RangeImage::create(*cloud_, *estimated, team);
    }
  }
  if (!image_) {
    takeBackStrays(cloud);
    why_no_image_ = describe(stray_reason_ == Misfit::moved ? Misfit::moved : explainMisfit(*cloud_, sample));
    return;
  }
  why_no_image_.clear();
  if (given && !given_fits) {
    warnings_.push_back("the camera's intrinsics do not fit the cloud; they were estimated from the cloud");
  }
  warnings_.push_back(straysText(strays_.size(), measured, stray_reason_));
}

/// Leaves out the points that are no range image's with these intrinsics. @return false: these are too many, or the
/// cloud was moved; then none is left out
bool UsableCloud::leaveOutStraysFrom(const PinholeIntrinsics& intrinsics, const PixelSample& sample)
{
  const std::size_t measured = countMeasured(cloud_->x.data(), cloud_->size());
  const auto most = static_cast<std::size_t>(kMostStrays * static_cast<double>(measured));
  const bool finite = std::isfinite(intrinsics.fx) && std::isfinite(intrinsics.fy) && std::isfinite(intrinsics.cx) &&
                      std::isfinite(intrinsics.cy);
  if (!finite) {
    return false;
  }
  listStrays(*cloud_, intrinsics, most, strays_);
  if (strays_.size() <= most) {
    stray_reason_ = explainStrays(*cloud_, sample, strays_);
    if (stray_reason_ != Misfit::moved) {
      leaveOut(strays_);
      return true;
    }
  }
  strays_.clear();
  return false;
}

void UsableCloud::takeBackStrays(const Cloud& cloud)
{
  for (const std::uint32_t i : strays_) {
    copy_.x[i] = cloud.x[i];
    copy_.y[i] = cloud.y[i];
    copy_.z[i] = cloud.z[i];
  }
  left_out_ -= strays_.size();
  strays_.clear();
  if (left_out_ == 0) {
    cloud_ = &cloud;
  }
}

void UsableCloud::leaveOut(const std::vector<std::uint32_t>& points)
{
  if (cloud_ != &copy_) {
    copy_ = *cloud_;
    cloud_ = &copy_;
  }
  for (const std::uint32_t i : points) {
    copy_.x[i] = copy_.y[i] = copy_.z[i] = std::nanf("");
  }
  left_out_ += points.size();
}

}  // namespace grasp_affordances
