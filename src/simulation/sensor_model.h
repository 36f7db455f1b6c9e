#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/parameters.h"

#include <cstdint>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// How a sensor measures depth. Structured light and stereo triangulate, by one law: the projector of the one stands
/// where the other has its second camera.
enum class SensorPrinciple
{
  structured_light,
  stereo,
  time_of_flight
};

/// Geometry and errors of a depth camera; the defaults are those of the Xtion. visitSensor() lists units and ranges,
/// config/sensors has the values of known sensors, and docs/simulation.md their sources.
///
/// A triangulating sensor with focal length f and baseline b sees a surface at depth z with the disparity d = f b / z.
/// It matches a window of its pattern. The measured disparity has steps of q and noise of standard deviation sigma. The
/// reported depth is z = f b / d, so that errors grow with the square of depth: dz = z^2 / (f b) dd. Of an Xtion at 1 m
/// a step is 2.9 mm; the standard deviation, with rounding to steps, is z^2 / (f b) sqrt(sigma^2 + q^2 / 12) = 1.6 mm.
struct SensorModel
{
  SensorPrinciple principle = SensorPrinciple::structured_light;

  // The image that the driver delivers.
  std::uint32_t width = 640;
  std::uint32_t height = 480;
  PinholeIntrinsics intrinsics{575.8, 575.8, 319.5, 239.5};
  double min_depth = 0.5;
  double max_depth = 5.0;

  /// The depth camera's own image, where depth is registered to another camera, as to color; without pixels: the image
  /// that is delivered is the depth camera's own.
  struct DepthCameraModel
  {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    PinholeIntrinsics intrinsics;
    double x = 0.0;  ///< m, place in the frame of the camera that depth is registered to
  };
  DepthCameraModel depth_camera;

  double projector_x = 0.075;  ///< m, from the depth camera

  // Noise.
  double disparity_noise = 0.06;
  double disparity_step = 0.125;
  double axial_constant = 0.0;
  double axial_linear = 0.0;
  double axial_quadratic = 0.0;
  std::uint32_t window_width = 9;
  std::uint32_t window_height = 4;

  // Depth edges.
  double edge_jitter = 0.8;
  double edge_loss = 0.31;
  std::uint32_t edge_ramp = 1;
  double flying_share = 0.0;

  // Surfaces.
  double grazing_cosine = 0.242;
  double dark_reach = 1.1;
  double shiny_loss = 0.0968;

  // Filters of the driver.
  std::uint32_t fill_width = 0;
  std::uint32_t smoothing_radius = 0;
  double smoothing_step = 0.02;

  bool exact = false;  ///< report the true depth of every surface that is not absorbing: no noise, no steps, no shadow
                       ///< of the projector, no missing pixels within the range

  bool registered() const { return depth_camera.width > 0; }

  /// What the depth camera alone delivers: its own image, not registered.
  SensorModel unregistered() const;

  /// The finest difference that the sensor can tell at that depth, in metres: a disparity step, or a millimetre for
  /// time of flight.
  double depthQuantum(double depth_m) const;
};

/// Visits every field that a sensor's file may give, as visitParameters() does those of a Config.
template <typename ModelT, typename Visitor>
void visitSensor(ModelT& m, Visitor&& visit)
{
  using Real = Range<double>;
  using Pixels = Range<std::uint32_t>;
  const Real focal{1.0, 1e5}, centre{-1e5, 1e5}, share{0.0, 1.0};
  visit("principle", m.principle, "how depth is measured: structured_light, stereo or time_of_flight");
  visit("image/width", m.width, Pixels{1, 4096}, "px", "columns of the image");
  visit("image/height", m.height, Pixels{1, 4096}, "px", "rows of the image");
  visit("image/fx", m.intrinsics.fx, focal, "px", "focal length along the rows");
  visit("image/fy", m.intrinsics.fy, focal, "px", "focal length along the columns");
  visit("image/cx", m.intrinsics.cx, centre, "px", "column of the optical axis");
  visit("image/cy", m.intrinsics.cy, centre, "px", "row of the optical axis");
  visit("range/min", m.min_depth, Real{0.001, 65.0}, "m", "nearest depth that is measured");
  visit("range/max", m.max_depth, Real{0.001, 65.0}, "m", "farthest depth that is measured");

  visit("depth_camera/width", m.depth_camera.width, Pixels{0, 4096}, "px",
        "columns of the depth camera's own image, where depth is registered to color; 0: it is not");
  visit("depth_camera/height", m.depth_camera.height, Pixels{0, 4096}, "px", "rows of the depth camera's own image");
  visit("depth_camera/fx", m.depth_camera.intrinsics.fx, Real{0.0, 1e5}, "px", "the depth camera's focal length, rows");
  visit("depth_camera/fy", m.depth_camera.intrinsics.fy, Real{0.0, 1e5}, "px",
        "the depth camera's focal length, columns");
  visit("depth_camera/cx", m.depth_camera.intrinsics.cx, centre, "px", "column of the depth camera's optical axis");
  visit("depth_camera/cy", m.depth_camera.intrinsics.cy, centre, "px", "row of the depth camera's optical axis");
  visit("depth_camera/x", m.depth_camera.x, Real{-1.0, 1.0}, "m",
        "place of the depth camera beside the color camera, positive to the right as the camera sees it");
  visit("projector_x", m.projector_x, Real{0.0, 2.0}, "m",
        "place of the projector or second camera to the right of the depth camera; 0: time of flight");

  visit("noise/disparity", m.disparity_noise, Real{0.0, 10.0}, "px",
        "standard deviation of a disparity before rounding to steps; triangulating sensors");
  visit("noise/disparity_step", m.disparity_step, Real{1e-4, 10.0}, "px", "step of disparities; triangulating sensors");
  visit("noise/axial_constant", m.axial_constant, Real{-0.1, 0.1}, "m",
        "a of the standard deviation a + b z + c z^2 of a depth z; time of flight");
  visit("noise/axial_linear", m.axial_linear, Real{-0.1, 0.1}, "m/m", "b of that standard deviation");
  visit("noise/axial_quadratic", m.axial_quadratic, Real{-0.1, 0.1}, "m/m^2", "c of that standard deviation");
  visit("noise/window_width", m.window_width, Pixels{1, 64}, "px",
        "columns of the window that pixels with correlated noise share");
  visit("noise/window_height", m.window_height, Pixels{1, 64}, "px", "rows of that window");

  visit("edges/jitter", m.edge_jitter, Real{0.0, 2.0}, "px",
        "standard deviation of the place of a depth edge, along rows and columns");
  visit("edges/loss", m.edge_loss, share, "", "share of the pixels next to a depth edge that are not measured");
  visit("edges/ramp", m.edge_ramp, Pixels{1, 31}, "px",
        "width over which depth passes from one surface to the other at an edge; 1: at once");
  visit("edges/flying_share", m.flying_share, share, "",
        "share of the pixels next to a depth edge whose depth is anywhere between the two surfaces");

  visit("surfaces/grazing_cosine", m.grazing_cosine, share, "",
        "cosine of the angle of incidence beyond which a surface is not measured");
  visit("surfaces/dark_reach", m.dark_reach, Real{0.01, 65.0}, "m",
        "depth up to which a dark surface is measured, seen at right angles");
  visit("surfaces/shiny_loss", m.shiny_loss, share, "",
        "share of a shiny surface that is not measured, beside where it mirrors the projector into the camera");

  visit("driver/fill_width", m.fill_width, Pixels{0, 640}, "px",
        "widest hole along a row that the driver fills, with the farther of the depths at its ends; 0: none");
  visit("driver/smoothing_radius", m.smoothing_radius, Pixels{0, 16}, "px",
        "radius of the square over which the driver averages depths; 0: it does not");
  visit("driver/smoothing_step", m.smoothing_step, Real{0.0001, 65.0}, "m",
        "largest difference to the depth in the middle of what is averaged, so that edges stay; 65: plain averages");
  visit("exact", m.exact, "report true depths: no noise, steps, shadows, nor holes within the range");
}

template <>
const std::vector<std::string>& enumWords<SensorPrinciple>();  // structured_light, stereo, time_of_flight
template <>
SensorPrinciple enumFromWord<SensorPrinciple>(const std::string& name, const std::string& word);

/// @throw ParameterError for a value outside its range, a range of depth that is empty, and a principle that does not
/// fit projector_x
void validate(const SensorModel& model);

/// Names of the known sensors: the files of config/sensors, which are compiled in.
const std::vector<std::string>& sensorNames();

/// @throw std::invalid_argument for a name that is not in sensorNames()
SensorModel sensorModel(const std::string& name);

/// What the YAML text does not give is as of SensorModel(). @throw ParameterError for text that is no YAML map, an
/// unknown key, a value of the wrong type or outside its range
SensorModel sensorModelFromYaml(const std::string& text);

/// As sensorModelFromYaml, from a file. @throw ParameterError also for a file that cannot be read
SensorModel sensorModelFromFile(const std::string& path);

/// sensorModelFromFile() for what ends in .yaml, else sensorModel(). @throw as these
SensorModel sensorModelFromNameOrFile(const std::string& name_or_path);

}  // namespace grasp_affordances
