#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"
#include "rendering/color.h"
#include "rendering/label_place.h"
#include "rendering/picture_camera.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances
{

/// Style of a drawn shell.
struct ShellStyle
{
  Color color;
  double line_opacity = 1.0;
  double fill_opacity = 0.2;
  double line_width = 2.0;  ///< pixels of the picture
  bool gap = true;          ///< draw the outline of the gap's outer radius, too
};

/// Style of a drawn body. Its silhouette is drawn.
struct BodyStyle
{
  Color color;
  double line_opacity = 1.0;
  double fill_opacity = 0.3;
  double line_width = 3.0;  ///< pixels of the picture
};

class Canvas;

/// An offscreen picture of a cloud, into which results are drawn. Needs no display.
class Picture
{
public:
  /// Draws the shaded cloud as its sensor sees it. @param colors  of the points; empty: grey
  explicit Picture(const Cloud& cloud, const std::vector<Color>& colors = {});

  /// The same for another camera.
  Picture(const Cloud& cloud, const std::vector<Color>& colors, const PictureCamera& camera);
  ~Picture();
  Picture(Picture&&) noexcept;
  Picture& operator=(Picture&&) noexcept;

  int width() const;   ///< pixels, a multiple of the camera's width, so that lines are finer than its pixels
  int height() const;  ///< pixels

  /// Position of a point (m, in the cloud's frame) in the picture, in pixels. Empty if it is behind the camera or far
  /// outside.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point) const;

  /// Draws a shell: the inner cylinder with its axis, and the gap around it. A shell is left out if a part of it is
  /// behind the camera or far outside. The same holds for the functions below.
  void drawShell(const Shell& shell, const ShellStyle& style);

  /// Draws a polyline (m, in the cloud's frame) and a tube around it.
  /// @param radius  of the tube, m
  void drawTube(const std::vector<Eigen::Vector3d>& line, double radius, const BodyStyle& style);

  /// Draws a convex body with the given corners (m, in the cloud's frame).
  void drawHull(const std::vector<Eigen::Vector3d>& corners, const BodyStyle& style);

  void drawArrow(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const BodyStyle& style);

  /// Writes a short text beside a tube, where it covers least of the tubes, bodies and labels drawn so far.
  void drawLabel(const std::string& text, const std::vector<Eigen::Vector3d>& line, double radius, const Color& color);

  /// Writes a line of text along the lower edge.
  void drawCaption(const std::string& text);

  /// Writes a PNG file. @throw std::runtime_error, with path and reason, if that fails.
  void save(const std::string& path) const;

private:
  void drawUnion(const std::vector<std::vector<Eigen::Vector2d>>& polygons, const BodyStyle& style);

  std::unique_ptr<Canvas> canvas_;
  std::vector<Rectangle> taken_;  // areas that labels should not cover
};

/// Draws the handles of a result, each in its own color: a bold tube along its axis, its id, its best hand pose as a
/// gripper, up to seven further hand poses as faint arrows along the approach, and its shells, faint. Shells without a
/// handle are grey.
void drawLocalization(Picture& picture, const Localization& localization, const Config& config);

}  // namespace grasp_affordances
