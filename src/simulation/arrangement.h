#pragma once

#include "simulation/counter_random.h"
#include "simulation/placement.h"
#include "simulation/scene.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace grasp_affordances
{

/// Points inside the material of an object, a millimetre and a half below its surface, in the scene's frame: where rays
/// parallel to its parts' axes enter and leave them, at least three in each direction and no more than 15 mm apart.
/// None for half-spaces.
std::vector<Eigen::Vector3d> pointsInside(const Scene& scene, std::size_t object);

/// Adds all objects of one scene to another.
void append(const Scene& from, const Eigen::Isometry3d& T_to_from, Scene& to);

/// What carries a scene, and where the camera may be.
struct Stage
{
  enum class Support
  {
    table,
    floor
  };
  Support support = Support::table;
  Eigen::Vector2d table_size{1.5, 1.1};                ///< m
  double wall = 0.0;                                   ///< m, y of a wall behind everything; 0: none
  double middle_height = 0.06;                         ///< m, of the point that is in the middle of the picture
  double min_distance = 0.7, max_distance = 0.85;      ///< m, from the camera to that point
  double min_elevation = 28.0, max_elevation = 48.0;   ///< degrees, of the camera as seen from there
  double nearest_object = 0.5, farthest_object = 2.0;  ///< m, from the camera to the middle of an object
};

/// Where an object may come to stand.
struct Spot
{
  Eigen::Vector2d middle;                ///< m
  Eigen::Vector2d spread{0.025, 0.025};  ///< m, to either side
  double yaw = 0.0;                      ///< degrees, of the object's front from x
  double turn = 180.0;                   ///< degrees, to either side
  double height = 0.0;                   ///< m, of what carries the object
};

/// Puts objects into a scene: inside the picture and apart from one another. Scene frame: z = 0 carries the objects, y
/// points away from the camera, and the middle of the picture shows a point above the origin. Half of the arrangements,
/// by a coin, are mirrored from left to right; objects are symmetric about their fronts.
class Arrangement
{
public:
  Arrangement(const Stage& stage, CounterRandom& random);

  /// Keeps about this distance, in m, between objects from now on: that of their pointsInside().
  void setGap(double gap) { gap_ = gap; }

  /// Puts an object, or several that belong together, somewhere about a spot, farther away from it where there is no
  /// room. @return the object's pose in the scene. @throw std::runtime_error where there is no room at all.
  Eigen::Isometry3d place(const Scene& object, const Spot& spot);

  /// The same, but no farther away. @return whether there was room at one of so many places drawn.
  bool tryToPlace(const Scene& object, const Spot& spot, int tries);

  const View& view() const { return view_; }

private:
  struct Body
  {
    explicit Body(const Scene& scene);
    Body(const Body& body, const Eigen::Isometry3d& T);

    Scene alone;
    std::vector<Eigen::Vector3d> points;
    Eigen::AlignedBox3d bounds;  ///< of the points
  };

  Eigen::Isometry3d draw(const Spot& spot, double widening);
  bool put(const Body& body, const Eigen::Isometry3d& T_scene_body);
  bool inRange(const Body& body) const;
  bool inPicture(const Body& body) const;
  bool intoStage(const Body& body) const;
  bool apart(const Body& a, const Body& b) const;

  Stage stage_;
  View view_;
  std::size_t stage_objects_;  ///< the first of the scene
  CounterRandom& random_;
  bool mirrored_;
  double gap_ = 0.02;
  std::vector<Body> bodies_;
};

}  // namespace grasp_affordances
