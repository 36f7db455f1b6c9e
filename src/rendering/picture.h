#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/localization.h"
#include "rendering/color.h"
#include "rendering/picture_camera.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// How a shell is drawn.
struct ShellStyle
{
  Color color;
  double line_opacity = 1.0;
  double fill_opacity = 0.2;
  double line_width = 2.0;  ///< pixels of the picture
  bool gap = true;          ///< outline the gap's outer radius, too
};

/// An offscreen picture of a cloud, seen from its sensor, that results are drawn into. Needs no display.
class Picture
{
public:
  /// Draws the cloud, shaded. @param colors  of the points; empty: grey
  explicit Picture(const Cloud& cloud, const std::vector<Color>& colors = {});

  /// The same as another camera sees it.
  Picture(const Cloud& cloud, const std::vector<Color>& colors, const PictureCamera& camera);
  ~Picture();
  Picture(Picture&&) noexcept;
  Picture& operator=(Picture&&) noexcept;

  int width() const;   ///< pixels: a multiple of the camera's, for lines finer than the sensor's pixels
  int height() const;  ///< pixels

  /// Where a point (m, in the cloud's frame) falls in the picture's pixels; empty behind the camera and far outside.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point) const;

  /// Draws the inner cylinder with its axis, and the gap around it. A shell that reaches behind the camera or far
  /// outside is left out.
  void drawShell(const Shell& shell, const ShellStyle& style);

  /// Draws a line of text along the lower edge.
  void drawCaption(const std::string& text);

  /// Writes a PNG file. @throw std::runtime_error, with path and reason.
  void save(const std::string& path) const;

private:
  class Canvas;
  std::unique_ptr<Canvas> canvas_;
};

/// Draws all shells. Those that overlap share a color; all are faint but the most typical one of such a group, so that
/// one cylinder per place stands out however many were found there.
void drawShells(Picture& picture, const std::vector<Shell>& shells);

}  // namespace grasp_affordances
