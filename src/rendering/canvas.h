#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/handle.h"
#include "rendering/color.h"
#include "rendering/picture_camera.h"

#include <cairo.h>
#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

namespace grasp_affordances
{

using Polygon = std::vector<Eigen::Vector2d>;  ///< corners in pixels of the picture

/// A picture of a shaded cloud, to draw on with cairo.
class Canvas
{
public:
  Canvas(const Cloud& cloud, const std::vector<Color>& colors, PictureCamera camera);

  int width() const;   ///< pixels, a multiple of the camera's
  int height() const;  ///< pixels
  cairo_t* context() const { return context_.get(); }
  cairo_surface_t* surface() const { return surface_.get(); }

  /// Position of a point in the picture. Empty if it is behind the camera or far outside.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point) const;

  /// Projects points and appends them to `pixels`. Returns false if one of them has no pixel.
  bool project(const Polyline& line, Polygon& pixels) const;

  void setColor(const Color& color, double opacity);

  /// Makes the polygon the current path, closed.
  void path(const Polygon& polygon);

  /// Draws a line in space. It is fainter where it is behind measured points.
  void stroke(const Polyline& line, const Color& color, double opacity);

private:
  struct Deleter
  {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
  };
  using Surface = std::unique_ptr<cairo_surface_t, Deleter>;

  static Surface createSurface(int width, int height);
  static Surface imageSurface(const std::vector<Color>& pixels, int width, int height);
  void moveTo(const Eigen::Vector3d& point);
  void lineTo(const Eigen::Vector3d& point);
  bool hidden(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  PictureCamera camera_;
  int scale_ = 1;
  std::vector<float> depth_;
  Surface surface_;
  std::unique_ptr<cairo_t, Deleter> context_;
};

}  // namespace grasp_affordances
