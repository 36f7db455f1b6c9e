#pragma once

#include "grasp_affordances/cloud.h"
#include "simulation/scene.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// What the virtual sensor measures with, and how badly.
///
/// A structured-light camera of focal length f and baseline b sees a surface at depth z with the disparity d = f b / z.
/// It matches its pattern in steps q and with noise sigma, and reports z = f b / d, so that errors grow with the square
/// of depth: dz = z^2 / (f b) dd. At 1 m, a step is 3.2 mm and the standard deviation, rounding to steps included, z^2
/// / (f b) sqrt(sigma^2 + q^2 / 12) = 1.6 mm.
///
/// Source: Khoshelham and Oude Elberink, "Accuracy and resolution of Kinect depth data for indoor mapping
/// applications", Sensors 12(2), 2012, equations 5 and 10: the Kinect, built on the same reference design, has f = 580
/// px, b = 7.5 cm, q = 1/8 px and a random error of half a step in all (1.4 mm at 1 m, 4 cm at 5 m).
struct XtionModel
{
  std::uint32_t width = 640;
  std::uint32_t height = 480;
  PinholeIntrinsics intrinsics{525.0, 525.0, 319.5, 239.5};
  double baseline = 0.075;        ///< m, between projector and camera
  double disparity_step = 0.125;  ///< px
  double disparity_noise = 0.05;  ///< px, standard deviation before rounding to steps
  double depth_step = 0.001;      ///< m, resolution of the reported depth
  double min_depth = 0.5;         ///< m; nearer surfaces are not measured
  double max_depth = 5.0;         ///< m; nor are farther ones
  bool exact = false;             ///< report the true depth: no noise, no steps
};

/// One measurement. Optical frame: x right, y down, z forward.
struct Frame
{
  Cloud cloud;                        ///< organized, with intrinsics; each point is on its pixel's ray
  std::vector<std::uint32_t> labels;  ///< of the points of the cloud; 0 where nothing was measured
};

/// A virtual Asus Xtion.
class Xtion
{
public:
  explicit Xtion(const XtionModel& model = XtionModel()) : model_(model) {}

  /// The frame depends on its arguments alone; the noise of a pixel on the seed, the pixel and the depth there.
  Frame capture(const Scene& scene, const Eigen::Isometry3d& T_scene_camera, std::uint64_t seed) const;

  const XtionModel& model() const { return model_; }

private:
  /// Depth as reported for a true depth, NaN where it is out of range; `noise` in standard deviations.
  double reportedDepth(double depth, double noise) const;

  XtionModel model_;
};

}  // namespace grasp_affordances
