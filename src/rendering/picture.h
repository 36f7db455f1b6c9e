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

/// How a shell is drawn.
struct ShellStyle
{
  Color color;
  double line_opacity = 1.0;
  double fill_opacity = 0.2;
  double line_width = 2.0;  ///< pixels of the picture
  bool gap = true;          ///< outline the gap's outer radius, too
};

/// How a body is drawn: its silhouette.
struct BodyStyle
{
  Color color;
  double line_opacity = 1.0;
  double fill_opacity = 0.3;
  double line_width = 3.0;  ///< pixels of the picture
};

class Canvas;

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

  /// Draws a tube about a line (m, in the cloud's frame), bent as that is, and the line. One that reaches behind the
  /// camera or far outside is left out, as all that follows.
  /// @param radius  m
  void drawTube(const std::vector<Eigen::Vector3d>& line, double radius, const BodyStyle& style);

  /// Draws the convex body that has these corners (m, in the cloud's frame).
  void drawHull(const std::vector<Eigen::Vector3d>& corners, const BodyStyle& style);

  void drawArrow(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const BodyStyle& style);

  /// Writes a few letters beside such a tube, where there is least of the tubes, bodies and labels drawn so far.
  void drawLabel(const std::string& text, const std::vector<Eigen::Vector3d>& line, double radius, const Color& color);

  /// Draws a line of text along the lower edge.
  void drawCaption(const std::string& text);

  /// Writes a PNG file. @throw std::runtime_error, with path and reason.
  void save(const std::string& path) const;

private:
  void drawUnion(const std::vector<std::vector<Eigen::Vector2d>>& polygons, const BodyStyle& style);

  std::unique_ptr<Canvas> canvas_;
  std::vector<Rectangle> taken_;  // where labels should not be
};

/// Draws handles, each in a color of its own: a bold tube along its axis with its id beside it, its best hand pose as a
/// gripper, the next seven as faint arrows along their approach, and its shells, faint. Shells of no handle are grey.
void drawLocalization(Picture& picture, const Localization& localization, const Config& config);

}  // namespace grasp_affordances
