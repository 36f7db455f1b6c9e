#pragma once

namespace grasp_affordances
{

/// Standard deviation (m) of a depth (m) that an Xtion measures: 0.8 mm + 1.6 mm (depth / 1 m)^2.
///
/// The second part is the error of the disparity, z^2 / (f b) times 0.07 px, which docs/simulation.md derives; it makes
/// 4 cm at 5 m, as Khoshelham and Oude Elberink measured (Accuracy and resolution of Kinect depth data for indoor
/// mapping applications, Sensors 12(2), 2012). The first part does not grow with depth. It is chosen, and stands for
/// the rest: steps of 1 mm, and surfaces that are not quite round.
constexpr double depthNoise(double depth)
{
  return 0.0008 + 0.0016 * depth * depth;
}

}  // namespace grasp_affordances
