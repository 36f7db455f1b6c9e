#include "rendering/picture.h"

#include "rendering/shaded_cloud.h"

#include <cairo.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr int kLongSide = 1280;      // pixels that the longer side of a picture has about
constexpr double kFarOutside = 1e5;  // camera pixels from the first one that cairo need not be asked to draw
constexpr int kRingSegments = 48;
constexpr double kHidden = 0.35;       // opacity of what lies behind measured points, relative to what does not
constexpr double kHiddenDepth = 0.01;  // m behind a point at which a line counts as hidden

using Polyline = std::vector<Eigen::Vector3d>;
using Polygon = std::vector<Eigen::Vector2d>;

struct CairoDeleter
{
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, CairoDeleter>;
using Context = std::unique_ptr<cairo_t, CairoDeleter>;

Surface createSurface(int width, int height)
{
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(std::string("no picture of this size: ") +
                             cairo_status_to_string(cairo_surface_status(surface.get())));
  }
  return surface;
}

Surface imageSurface(const std::vector<Color>& pixels, int width, int height)
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

/// Two end rings of a cylinder around a shell's axis.
std::array<Polyline, 2> endRings(const Shell& shell, double radius)
{
  const Eigen::Vector3d third = shell.axis.cross(shell.normal);
  std::array<Polyline, 2> rings;
  for (int end = 0; end < 2; ++end) {
    const Eigen::Vector3d center = shell.centroid + (end - 0.5) * shell.length * shell.axis;
    for (int i = 0; i <= kRingSegments; ++i) {
      const double angle = 2.0 * kPi * i / kRingSegments;
      rings[end].push_back(center + radius * (std::cos(angle) * shell.normal + std::sin(angle) * third));
    }
  }
  return rings;
}

double cross(const Eigen::Vector2d& origin, const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return (a - origin).x() * (b - origin).y() - (a - origin).y() * (b - origin).x();
}

/// Monotone chain. The hull of a cylinder's end rings is its silhouette.
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

cairo_status_t writeTo(void* file, const unsigned char* data, unsigned int size)
{
  auto& stream = *static_cast<std::ofstream*>(file);
  return stream.write(reinterpret_cast<const char*>(data), size) ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

}  // namespace

class Picture::Canvas
{
public:
  Canvas(const Cloud& cloud, const std::vector<Color>& colors, const PictureCamera& camera) : camera_(camera)
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

  int width() const { return scale_ * static_cast<int>(camera_.width); }
  int height() const { return scale_ * static_cast<int>(camera_.height); }
  cairo_t* context() const { return context_.get(); }
  cairo_surface_t* surface() const { return surface_.get(); }

  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point) const
  {
    const auto pixel = camera_.project(camera_.camera_from_cloud * point);
    if (!pixel || pixel->cwiseAbs().maxCoeff() > kFarOutside) {
      return std::nullopt;
    }
    return scale_ * (*pixel + Eigen::Vector2d(0.5, 0.5));
  }

  /// False where a point is behind the camera.
  bool project(const Polyline& line, Polygon& pixels) const
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

  void setColor(const Color& color, double opacity)
  {
    cairo_set_source_rgba(context(), color.r, color.g, color.b, opacity);
  }

  void path(const Polygon& polygon)
  {
    cairo_new_path(context());
    for (const Eigen::Vector2d& point : polygon) {
      cairo_line_to(context(), point.x(), point.y());
    }
    cairo_close_path(context());
  }

  /// Strokes a line in space, fainter where it runs behind measured points.
  void stroke(const Polyline& line, const Color& color, double opacity)
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

private:
  void moveTo(const Eigen::Vector3d& point)
  {
    if (const auto pixel = project(point)) {
      cairo_move_to(context(), pixel->x(), pixel->y());
    }
  }

  void lineTo(const Eigen::Vector3d& point)
  {
    if (const auto pixel = project(point)) {
      cairo_line_to(context(), pixel->x(), pixel->y());
    }
  }

  bool hidden(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const
  {
    const Eigen::Vector3d middle = camera_.camera_from_cloud * (0.5 * (from + to));
    const auto pixel = camera_.project(middle);
    if (!pixel || !(pixel->x() > -0.5 && pixel->y() > -0.5 && pixel->x() < camera_.width - 0.5 &&
                    pixel->y() < camera_.height - 0.5)) {
      return false;
    }
    const auto column = static_cast<std::size_t>(pixel->x() + 0.5);
    const auto row = static_cast<std::size_t>(pixel->y() + 0.5);
    return depth_[row * camera_.width + column] < middle.z() - kHiddenDepth;
  }

  PictureCamera camera_;
  int scale_ = 1;
  std::vector<float> depth_;
  Surface surface_;
  Context context_;
};

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
  canvas_->setColor({1.0F, 1.0F, 1.0F}, style.line_opacity);
  cairo_set_line_width(context, style.line_width);
  cairo_stroke(context);
}

void Picture::drawCaption(const std::string& text)
{
  constexpr double kSize = 22.0;
  cairo_t* context = canvas_->context();
  cairo_rectangle(context, 0, height() - 1.7 * kSize, width(), 1.7 * kSize);
  canvas_->setColor({0.0F, 0.0F, 0.0F}, 0.6);
  cairo_fill(context);
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, kSize);
  cairo_move_to(context, 0.6 * kSize, height() - 0.55 * kSize);
  canvas_->setColor({1.0F, 1.0F, 1.0F}, 1.0);
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
    throw std::runtime_error("cannot write the picture " + path + ": " + std::strerror(errno != 0 ? errno : EIO));
  }
}

}  // namespace grasp_affordances
