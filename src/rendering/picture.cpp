#include "rendering/picture.h"

#include "core/result/axis_frame.h"
#include "core/result/polyline.h"
#include "rendering/canvas.h"
#include "rendering/label_place.h"

#include <cairo.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr int kRingSegments = 48;
constexpr double kArrowHead = 14.0;      // pixels
constexpr double kLabelSize = 40.0;      // pixels, size of the font
constexpr double kCaptionHeight = 38.0;  // pixels
constexpr Color kWhite{1.0F, 1.0F, 1.0F};
constexpr Color kBlack{0.0F, 0.0F, 0.0F};

/// @param normal  unit vector, at right angles to the axis, which is a unit vector, too
Polyline ring(const Eigen::Vector3d& center, const Eigen::Vector3d& axis, const Eigen::Vector3d& normal, double radius)
{
  const Eigen::Vector3d third = axis.cross(normal);
  Polyline points;
  for (int i = 0; i <= kRingSegments; ++i) {
    const double angle = 2.0 * kPi * i / kRingSegments;
    points.push_back(center + radius * (std::cos(angle) * normal + std::sin(angle) * third));
  }
  return points;
}

/// The two end circles of a cylinder around a shell's axis.
std::array<Polyline, 2> endRings(const Shell& shell, double radius)
{
  const Eigen::Vector3d half = 0.5 * shell.length * shell.axis;
  const Eigen::Vector3d normal = normalOrAny(shell.axis, shell.normal);
  return {ring(shell.centroid - half, shell.axis, normal, radius),
          ring(shell.centroid + half, shell.axis, normal, radius)};
}

/// A circle about each point of a line, at right angles to the line at that point.
std::vector<Polyline> tubeRings(const Polyline& line, double radius)
{
  std::vector<Polyline> rings;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Eigen::Vector3d along = chordAround(line, i);
    const Eigen::Vector3d axis = along.norm() > 0.0 ? Eigen::Vector3d(along.normalized()) : Eigen::Vector3d::UnitZ();
    rings.push_back(ring(line[i], axis, axis.unitOrthogonal(), radius));
  }
  return rings;
}

double cross(const Eigen::Vector2d& origin, const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return (a - origin).x() * (b - origin).y() - (a - origin).y() * (b - origin).x();
}

/// Convex hull, by the monotone chain algorithm. The hull of a cylinder's end circles is its silhouette.
Polygon convexHull(Polygon points)
{
  std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  Polygon hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t begin = hull.size();
    for (const Eigen::Vector2d& point : points) {
      while (hull.size() >= begin + 2 && cross(hull[hull.size() - 2], hull.back(), point) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

Rectangle boundingBox(const Polygon& pixels)
{
  Rectangle box;
  for (const Eigen::Vector2d& pixel : pixels) {
    box.extend(pixel);
  }
  return box;
}

cairo_status_t writeTo(void* file, const unsigned char* data, unsigned int size)
{
  auto& stream = *static_cast<std::ofstream*>(file);
  return stream.write(reinterpret_cast<const char*>(data), size) ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

}  // namespace

Picture::Picture(const Cloud& cloud, const std::vector<Color>& colors) : Picture(cloud, colors, pictureCamera(cloud)) {}

Picture::Picture(const Cloud& cloud, const std::vector<Color>& colors, const PictureCamera& camera)
    : canvas_(std::make_unique<Canvas>(cloud, colors, camera))
{
}

Picture::~Picture() = default;
Picture::Picture(Picture&&) noexcept = default;
Picture& Picture::operator=(Picture&&) noexcept = default;

int Picture::width() const
{
  return canvas_->width();
}

int Picture::height() const
{
  return canvas_->height();
}

std::optional<Eigen::Vector2d> Picture::project(const Eigen::Vector3d& point) const
{
  return canvas_->project(point);
}

void Picture::drawShell(const Shell& shell, const ShellStyle& style)
{
  const auto inner = endRings(shell, shell.inner_radius);
  const auto outer = endRings(shell, shell.inner_radius + shell.thickness);
  Polygon inner_pixels, outer_pixels;
  if (!canvas_->project(inner[0], inner_pixels) || !canvas_->project(inner[1], inner_pixels) ||
      !canvas_->project(outer[0], outer_pixels) || !canvas_->project(outer[1], outer_pixels)) {
    return;
  }
  cairo_t* context = canvas_->context();
  canvas_->path(convexHull(inner_pixels));
  canvas_->setColor(style.color, style.fill_opacity);
  cairo_fill_preserve(context);
  canvas_->setColor(style.color, style.line_opacity);
  cairo_set_line_width(context, style.line_width);
  cairo_stroke(context);
  canvas_->stroke(inner[0], style.color, style.line_opacity);
  canvas_->stroke(inner[1], style.color, style.line_opacity);
  if (style.gap) {
    canvas_->path(convexHull(outer_pixels));
    canvas_->setColor(style.color, 0.7 * style.line_opacity);
    cairo_set_line_width(context, 0.5 * style.line_width);
    cairo_stroke(context);
  }
  const Eigen::Vector3d half = 0.5 * shell.length * shell.axis;
  const auto from = canvas_->project(shell.centroid - half);
  const auto to = canvas_->project(shell.centroid + half);
  cairo_move_to(context, from->x(), from->y());
  cairo_line_to(context, to->x(), to->y());
  canvas_->setColor(kWhite, style.line_opacity);
  cairo_set_line_width(context, style.line_width);
  cairo_stroke(context);
}

void Picture::drawTube(const Polyline& line, double radius, const BodyStyle& style)
{
  const std::vector<Polyline> rings = tubeRings(line, radius);
  std::vector<Polygon> segments;
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    Polygon pixels;
    if (!canvas_->project(rings[i], pixels) || !canvas_->project(rings[i + 1], pixels)) {
      return;
    }
    segments.push_back(convexHull(pixels));
    taken_.push_back(boundingBox(segments.back()));
  }
  drawUnion(segments, style);
  cairo_set_line_width(canvas_->context(), style.line_width);
  canvas_->stroke(line, kWhite, style.line_opacity);
}

void Picture::drawHull(const Polyline& corners, const BodyStyle& style)
{
  Polygon pixels;
  if (canvas_->project(corners, pixels)) {
    taken_.push_back(boundingBox(pixels));
    drawUnion({convexHull(pixels)}, style);
  }
}

/// Draws all outlines first. The fillings then replace the parts of outlines that they cover, so that one outline
/// remains around all polygons together.
void Picture::drawUnion(const std::vector<Polygon>& polygons, const BodyStyle& style)
{
  cairo_t* context = canvas_->context();
  cairo_push_group(context);
  cairo_set_line_width(context, 2.0 * style.line_width);
  canvas_->setColor(style.color, style.line_opacity);
  for (const Polygon& polygon : polygons) {
    canvas_->path(polygon);
    cairo_stroke(context);
  }
  cairo_set_operator(context, CAIRO_OPERATOR_SOURCE);
  canvas_->setColor(style.color, style.fill_opacity);
  for (const Polygon& polygon : polygons) {
    canvas_->path(polygon);
    cairo_fill(context);
  }
  cairo_pop_group_to_source(context);
  cairo_paint(context);
}

void Picture::drawArrow(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const BodyStyle& style)
{
  Polygon ends;
  if (!canvas_->project({from, to}, ends)) {
    return;
  }
  const Eigen::Vector2d along = (ends[1] - ends[0]).stableNormalized();
  const double head = std::min(kArrowHead, 0.5 * (ends[1] - ends[0]).norm());
  const Eigen::Vector2d neck = ends[1] - head * along, side = 0.4 * head * along.unitOrthogonal();
  cairo_t* context = canvas_->context();
  canvas_->setColor(style.color, style.line_opacity);
  cairo_set_line_width(context, style.line_width);
  cairo_move_to(context, ends[0].x(), ends[0].y());
  cairo_line_to(context, neck.x(), neck.y());
  cairo_stroke(context);
  canvas_->path({ends[1], neck + side, neck - side});
  cairo_fill(context);
}

void Picture::drawLabel(const std::string& text, const Polyline& line, double radius, const Color& color)
{
  Polygon pixels;
  for (const Polyline& ring : tubeRings(line, radius)) {
    if (!canvas_->project(ring, pixels)) {
      return;
    }
  }
  cairo_t* context = canvas_->context();
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_BOLD);
  cairo_set_font_size(context, kLabelSize);
  cairo_text_extents_t extents;
  cairo_text_extents(context, text.c_str(), &extents);
  const Rectangle picture(Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(width(), height() - kCaptionHeight));
  const Rectangle place = labelPlace(picture, boundingBox(pixels), {extents.width, extents.height}, taken_);
  taken_.push_back(place);
  cairo_move_to(context, place.min().x() - extents.x_bearing, place.min().y() - extents.y_bearing);
  cairo_text_path(context, text.c_str());
  canvas_->setColor(kBlack, 0.85);
  cairo_set_line_width(context, 0.25 * kLabelSize);
  cairo_stroke_preserve(context);
  canvas_->setColor(color, 1.0);
  cairo_fill(context);
}

void Picture::drawCaption(const std::string& text)
{
  constexpr double kSize = 22.0;
  cairo_t* context = canvas_->context();
  cairo_rectangle(context, 0, height() - kCaptionHeight, width(), kCaptionHeight);
  canvas_->setColor(kBlack, 0.6);
  cairo_fill(context);
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, kSize);
  cairo_move_to(context, 0.6 * kSize, height() - 0.55 * kSize);
  canvas_->setColor(kWhite, 1.0);
  cairo_show_text(context, text.c_str());
}

void Picture::save(const std::string& path) const
{
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  const bool written = file &&
                       cairo_surface_write_to_png_stream(canvas_->surface(), writeTo, &file) == CAIRO_STATUS_SUCCESS &&
                       file.flush();
  if (!written) {
    throw std::runtime_error("cannot write the picture " + path + ": " +
                             std::generic_category().message(errno != 0 ? errno : EIO));
  }
}

}  // namespace grasp_affordances
