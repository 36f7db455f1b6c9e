#pragma once

#include "simulation/primitive.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// What a surface does with the sensor's infrared light.
enum class Surface
{
  diffuse,      ///< is measured
  dark,         ///< returns little light: not always measured, the less the farther and the more slanted
  shiny,        ///< is not measured where it mirrors the projector into the camera, and not always elsewhere
  transparent,  ///< seldom measured; mostly what lies behind it is
  absorbing     ///< hides what lies behind it and is not measured itself
};

/// A solid in its place.
struct Part
{
  Primitive shape;
  Eigen::Isometry3d T_scene_shape;
  Surface surface;
  std::size_t object;  ///< index into Scene::objects()
};

/// Solids that may overlap; what the sensor sees is their union. An object is made of one or several parts.
class Scene
{
public:
  /// Parts added from now on belong to a new object of this name. Names need not be unique.
  void beginObject(const std::string& name);

  /// @return the part's index. @throw std::invalid_argument for a shape whose dimensions describe no solid.
  std::size_t add(const Primitive& shape, const Eigen::Isometry3d& T_scene_shape, Surface surface = Surface::diffuse);

  /// Declares that parts follow one another, in this order, along one axis that a hand may close around anywhere: the
  /// arc and the straights of a handle, or shoulder, neck and cap of a bottle. None may reach into a later one. A part
  /// belongs to one chain at most; those in none stand for themselves. @throw std::invalid_argument for an unknown or
  /// already joined part.
  void join(const std::vector<std::size_t>& parts);

  const std::vector<Part>& parts() const { return parts_; }
  const std::vector<std::string>& objects() const { return objects_; }
  const std::vector<std::vector<std::size_t>>& chains() const { return chains_; }

private:
  std::vector<Part> parts_;
  std::vector<std::string> objects_;
  std::vector<std::vector<std::size_t>> chains_;
};

/// A scene and where it is seen from.
struct View
{
  Scene scene;
  Eigen::Isometry3d T_scene_camera = Eigen::Isometry3d::Identity();  ///< optical frame of the camera
};

}  // namespace grasp_affordances
