#pragma once

#include "simulation/primitive.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// How a surface reflects the sensor's infrared light.
enum class Surface
{
  diffuse,      ///< always measured
  dark,         ///< returns little light; less often measured if far away or slanted
  shiny,        ///< not measured where it reflects the projector into the camera; often measured elsewhere
  transparent,  ///< seldom measured; mostly the surface behind it is
  absorbing     ///< not measured; hides what is behind it
};

/// A solid with its pose in the scene.
struct Part
{
  Primitive shape;
  Eigen::Isometry3d T_scene_shape;
  Surface surface;
  std::size_t object;  ///< index into Scene::objects()
};

/// What an object is to a scene. A background replaces supports, floors and walls, and leaves things as they are.
enum class Role
{
  thing,      ///< stands or hangs somewhere; may be grasped
  front,      ///< of a door, a drawer or an appliance; things are mounted on it
  support,    ///< a table, or a floor without one: what the things stand on. Its top is z = 0
  floor,      ///< below a table
  wall,       ///< behind the things; some may lean or hang on it
  background  ///< far away; a bar that could be grasped there is doubtful
};

/// A set of solids. They may overlap; the sensor sees their union. An object has one or several parts.
class Scene
{
public:
  /// Starts a new object. Parts that are added from now on belong to it. Names need not be unique.
  void beginObject(const std::string& name, Role role = Role::thing);

  /// @return the part's index. @throw std::invalid_argument if the shape's dimensions do not describe a solid.
  std::size_t add(const Primitive& shape, const Eigen::Isometry3d& T_scene_shape, Surface surface = Surface::diffuse);

  /// Joins parts to a chain: in the given order they follow one another along one axis, and a hand can close around any
  /// place of it. Examples are the arc and the straight pieces of a handle, or shoulder, neck and cap of a bottle. No
  /// part may extend into a later one. A part belongs to at most one chain.
  /// @throw std::invalid_argument for a part that is unknown or already joined.
  void join(const std::vector<std::size_t>& parts);

  const std::vector<Part>& parts() const { return parts_; }
  const std::vector<std::string>& objects() const { return objects_; }
  const std::vector<Role>& roles() const { return roles_; }  ///< of the objects
  const std::vector<std::vector<std::size_t>>& chains() const { return chains_; }

private:
  std::vector<Part> parts_;
  std::vector<std::string> objects_;
  std::vector<Role> roles_;
  std::vector<std::vector<std::size_t>> chains_;
};

/// A scene and the camera's pose.
struct View
{
  Scene scene;
  Eigen::Isometry3d T_scene_camera = Eigen::Isometry3d::Identity();  ///< optical frame of the camera
};

}  // namespace grasp_affordances
