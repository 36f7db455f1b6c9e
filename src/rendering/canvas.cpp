#include "rendering/canvas.h"

#include "rendering/shaded_cloud.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr int kLongSide = 1280;        // pixels, approximate length of the picture's longer side
constexpr double kFarOutside = 1e5;    // camera pixels; what is farther outside is not passed to cairo
constexpr double kHidden = 0.35;       // opacity of hidden lines, relative to visible ones
constexpr double kHiddenDepth = 0.01;  // m; a line that is so far behind a measured point is hidden

}  // namespace

Canvas::Canvas(const Cloud& cloud, const std::vector<Color>& colors, PictureCamera camera) : camera_(std::move(camera))
{
  const int longer = static_cast<int>(std::max(camera_.width, camera_.height));
  scale_ = std::max(1, (kLongSide + longer / 2) / longer);
  const int columns = static_cast<int>(camera_.width);
  const int rows = static_cast<int>(camera_.height);
  ShadedCloud shaded = shade(cloud, colors, camera_);
  depth_ = std::move(shaded.depth);
  surface_ = createSurface(scale_ * columns, scale_ * rows);
  context_.reset(cairo_create(surface_.get()));
  const Surface image = imageSurface(shaded.pixels, columns, rows);
  cairo_save(context_.get());
  cairo_scale(context_.get(), scale_, scale_);
  cairo_set_source_surface(context_.get(), image.get(), 0, 0);
  cairo_pattern_set_filter(cairo_get_source(context_.get()), CAIRO_FILTER_BILINEAR);
  cairo_pattern_set_extend(cairo_get_source(context_.get()), CAIRO_EXTEND_PAD);
  cairo_paint(context_.get());
  cairo_restore(context_.get());
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(context_.get(), CAIRO_LINE_CAP_ROUND);
}

int Canvas::width() const
{
  return scale_ * static_cast<int>(camera_.width);
}

int Canvas::height() const
{
  return scale_ * static_cast<int>(camera_.height);
}

std::optional<Eigen::Vector2d> Canvas::project(const Eigen::Vector3d& point) const
{
  const auto pixel = camera_.project(camera_.camera_from_cloud * point);
  if (!pixel || pixel->cwiseAbs().maxCoeff() > kFarOutside) {
    return std::nullopt;
  }
  return scale_ * (*pixel + Eigen::Vector2d(0.5, 0.5));
}

bool Canvas::project(const Polyline& line, Polygon& pixels) const
{
  for (const Eigen::Vector3d& point : line) {
    const auto pixel = project(point);
    if (!pixel) {
      return false;
    }
    pixels.push_back(*pixel);
  }
  return true;
}

void Canvas::setColor(const Color& color, double opacity)
{
  cairo_set_source_rgba(context(), color.r, color.g, color.b, opacity);
}

void Canvas::path(const Polygon& polygon)
{
  cairo_new_path(context());
  for (const Eigen::Vector2d& point : polygon) {
    cairo_line_to(context(), point.x(), point.y());
  }
  cairo_close_path(context());
}

void Canvas::stroke(const Polyline& line, const Color& color, double opacity)
{
  std::size_t i = 0;
  while (i + 1 < line.size()) {
    const bool is_hidden = hidden(line[i], line[i + 1]);
    moveTo(line[i]);
    for (; i + 1 < line.size() && hidden(line[i], line[i + 1]) == is_hidden; ++i) {
      lineTo(line[i + 1]);
    }
    setColor(color, is_hidden ? kHidden * opacity : opacity);
    cairo_stroke(context());
  }
}

Canvas::Surface Canvas::createSurface(int width, int height)
{
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(std::string("no picture of this size: ") +
                             cairo_status_to_string(cairo_surface_status(surface.get())));
  }
  return surface;
}

Canvas::Surface Canvas::imageSurface(const std::vector<Color>& pixels, int width, int height)
{
  Surface surface = createSurface(width, height);
  const auto component = [](float value) {
    return static_cast<std::uint32_t>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F)));
  };
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int row = 0; row < height; ++row) {
    unsigned char* line = cairo_image_surface_get_data(surface.get()) + row * stride;
    for (int column = 0; column < width; ++column) {
      const Color& color = pixels[static_cast<std::size_t>(row) * width + column];
      const std::uint32_t rgb = component(color.r) << 16 | component(color.g) << 8 | component(color.b);
      std::memcpy(line + 4 * column, &rgb, sizeof(rgb));
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

void Canvas::moveTo(const Eigen::Vector3d& point)
{
  if (const auto pixel = project(point)) {
    cairo_move_to(context(), pixel->x(), pixel->y());
  }
}

void Canvas::lineTo(const Eigen::Vector3d& point)
{
  if (const auto pixel = project(point)) {
    cairo_line_to(context(), pixel->x(), pixel->y());
  }
}

bool Canvas::hidden(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const
{
  const Eigen::Vector3d middle = camera_.camera_from_cloud * (0.5 * (from + to));
  const auto pixel = camera_.project(middle);
  if (!pixel || !(pixel->x() > -0.5 && pixel->y() > -0.5 && pixel->x() < camera_.width - 0.5 &&
                  pixel->y() < camera_.height - 0.5)) {
    return false;
  }
  const auto column = static_cast<std::size_t>(std::lround(pixel->x()));
  const auto row = static_cast<std::size_t>(std::lround(pixel->y()));
  return depth_[row * camera_.width + column] < middle.z() - kHiddenDepth;
}

}  // namespace grasp_affordances
