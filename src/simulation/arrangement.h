#pragma once

#include "simulation/counter_random.h"
#include "simulation/placement.h"
#include "simulation/scene.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace grasp_affordances
{

/// Points inside the material of an object, 1.5 mm below its surface, in the scene's frame. They are where rays
/// parallel to the axes of its parts enter and leave the parts: at least three rays in each direction, at most 15 mm
/// apart. Half-spaces have no such points.
std::vector<Eigen::Vector3d> pointsInside(const Scene& scene, std::size_t object);

/// Adds all objects of one scene to another.
void append(const Scene& from, const Eigen::Isometry3d& T_to_from, Scene& to);

/// What the objects stand on, and the range of camera poses.
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
  double middle_height = 0.06;                         ///< m, height of the point in the middle of the picture
  double min_distance = 0.7, max_distance = 0.85;      ///< m, from the camera to that point
  double min_elevation = 28.0, max_elevation = 48.0;   ///< degrees, of the camera as seen from there
  double nearest_object = 0.5, farthest_object = 2.0;  ///< m, from the camera to the middle of an object
};

/// Range of places for an object.
struct Spot
{
  Eigen::Vector2d middle;                ///< m
  Eigen::Vector2d spread{0.025, 0.025};  ///< m, to either side
  double yaw = 0.0;                      ///< degrees, direction of the object's front, from x
  double turn = 180.0;                   ///< degrees, to either side
  double height = 0.0;                   ///< m, height of the surface that the object stands on
};

/// Places objects in a scene, inside the picture and apart from one another. Scene frame: objects stand on z = 0, y
/// points away from the camera, and the middle of the picture shows a point above the origin. Each arrangement is
/// mirrored from left to right with a probability of one half. The objects themselves are symmetric about their fronts.
class Arrangement
{
public:
  Arrangement(const Stage& stage, CounterRandom& random);

  /// Sets the least distance, in m, between objects that are placed from now on. It is measured between their
  /// pointsInside(), so that it is approximate.
  void setGap(double gap) { gap_ = gap; }

  /// Places an object, or several that belong together, near a spot. If there is no room, it tries farther away.
  /// @return the object's pose in the scene. @throw std::runtime_error if there is no room at all.
  Eigen::Isometry3d place(const Scene& object, const Spot& spot);

  /// The same, but does not try farther away. @return whether there was room at one of so many drawn places.
  bool tryToPlace(const Scene& object, const Spot& spot, int tries);

  const View& view() const { return view_; }

private:
  struct Body
  {
    explicit Body(const Scene& scene);
    Body(const Body& body, const Eigen::Isometry3d& T);

    Scene alone;
    std::vector<Eigen::Vector3d> points;
    Eigen::AlignedBox3d bounds;  ///< bounding box of the points
  };

  Eigen::Isometry3d draw(const Spot& spot, double widening);
  bool put(const Body& body, const Eigen::Isometry3d& T_scene_body);
  bool inRange(const Body& body) const;
  bool inPicture(const Body& body) const;
  bool intoStage(const Body& body) const;
  bool apart(const Body& a, const Body& b) const;

  Stage stage_;
  View view_;
  std::size_t stage_objects_;  ///< number of objects that belong to the stage; they are the scene's first
  CounterRandom& random_;
  bool mirrored_;
  double gap_ = 0.02;
  std::vector<Body> bodies_;
};

}  // namespace grasp_affordances
