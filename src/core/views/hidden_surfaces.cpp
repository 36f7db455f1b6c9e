#include "core/views/hidden_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace grasp_affordances
{
namespace
{

/// Inverse depth = at + slope * pixel.
struct Line
{
  double at, slope;

  double operator()(int pixel) const { return at + slope * pixel; }
};

/// Two stretches of a scan line that belong to one surface: one ends at the pixel `left`, the other begins at `right`.
struct Bridge
{
  int left, right;
  Line line;
};

/// A row or column of the image: the inverse depth of each pixel, NaN where nothing was measured, and the bridges in
/// it.
class ScanLine
{
public:
  /// Takes the arrays of findSurfaceEnds, from the first numbers of this line on.
  ScanLine(const double* inverse_depth, const double* sums) : inverse_depth_(inverse_depth), sums_(sums) {}

  bool measuredAt(int pixel, const Line& line) const
  {
    return std::abs(inverseDepth(pixel) - line(pixel)) <= kSurfaceTolerance;
  }

  /// Calls visit(bridge) for all bridges that are no wider than `max_width` (m). `focal_length`: pixels.
  template <typename Visitor>
  void visitBridges(const std::vector<int>& left, const std::vector<int>& right, double max_width, double focal_length,
                    Visitor&& visit) const;

private:
  struct Sums
  {
    double n, i, ii, d, id;

    Sums operator+(const Sums& other) const
    {
      return {n + other.n, i + other.i, ii + other.ii, d + other.d, id + other.id};
    }
    Sums operator-(const Sums& other) const
    {
      return {n - other.n, i - other.i, ii - other.ii, d - other.d, id - other.id};
    }
    Line line() const
    {
      const double slope = (id * n - i * d) / (ii * n - i * i);
      return {(d - slope * i) / n, slope};
    }
  };

  double inverseDepth(int pixel) const { return inverse_depth_[pixel * kScanLines]; }
  Sums sumsBefore(int pixel) const
  {
    const double* sums = sums_ + pixel * kLineSums * kScanLines;
    return {sums[0], sums[kScanLines], sums[2 * kScanLines], sums[3 * kScanLines], sums[4 * kScanLines]};
  }
  Sums stretch(int first) const { return sumsBefore(first + kStretch) - sumsBefore(first); }
  bool measuredBehind(int pixel, const Line& line) const
  {
    return inverseDepth(pixel) < line(pixel) - kSurfaceTolerance;
  }
  std::optional<Line> commonLine(int left, int right) const;

  const double* inverse_depth_;
  const double* sums_;
};

/// The line through the stretches on both sides. Empty where they do not lie on one line, or where something between
/// them was measured behind it.
std::optional<Line> ScanLine::commonLine(int left, int right) const
{
  const Sums before = stretch(left - kStretch + 1), after = stretch(right);
  const Line line = (before + after).line();
  for (int k = 0; k < kStretch; ++k) {
    for (const int pixel : {left - k, right + k}) {
      if (!std::isnan(inverseDepth(pixel)) && !measuredAt(pixel, line)) {
        return std::nullopt;
      }
    }
  }
  for (int pixel = left + 1; pixel < right; ++pixel) {
    if (measuredBehind(pixel, line)) {
      return std::nullopt;
    }
  }
  return line;
}

template <typename Visitor>
void ScanLine::visitBridges(const std::vector<int>& left, const std::vector<int>& right, double max_width,
                            double focal_length, Visitor&& visit) const
{
  auto first = right.begin();
  for (const int l : left) {
    first = std::find_if(first, right.end(), [&](int r) { return r > l + 1; });
    for (auto r = first; r != right.end(); ++r) {
      const double depth = 1.0 / std::max(inverseDepth(l), inverseDepth(*r));
      if ((*r - l) * depth > max_width * focal_length) {
        break;
      }
      if (const auto line = commonLine(l, *r)) {
        visit(Bridge{l, *r, *line});
        break;
      }
    }
  }
}

/// Lists, for each line, the pixels whose bit is set.
void listPixels(const std::vector<std::uint8_t>& bits, std::size_t size,
                std::array<std::vector<int>, kScanLines>& pixels)
{
  for (auto& of_line : pixels) {
    of_line.clear();
  }
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t line = 0, rest = bits[i]; rest != 0; ++line, rest >>= 1U) {
      if ((rest & 1U) != 0) {
        pixels[line].push_back(static_cast<int>(i));
      }
    }
  }
}

}  // namespace

void HiddenSurfaces::Block::resize(std::size_t pixels)
{
  depth.resize(pixels * kScanLines);
  inverse_depth.resize(pixels * kScanLines);
  sums.resize((pixels + 1) * kLineSums * kScanLines);
  last.resize(pixels);
  first.resize(pixels);
  for (std::size_t line = 0; line < kScanLines; ++line) {
    left[line].reserve(pixels);
    right[line].reserve(pixels);
  }
}

void HiddenSurfaces::update(const RangeImage& image, double max_width, ThreadTeam& team)
{
  const std::uint32_t width = image.cloud().width, height = image.cloud().height;
  if (cloud_.width != width || cloud_.height != height) {
    cloud_.reset(width, height);
    tile_columns_ = (width + kTile - 1) / kTile;
    tile_rows_ = (height + kTile - 1) / kTile;
    tiles_.assign(tile_columns_ * tile_rows_, 0);
  }
  blocks_.resize(team.size());
  for (Block& block : blocks_) {
    block.resize(std::max(width, height));
  }
  team.forEach(tile_rows_, [&](std::size_t tile, std::size_t member) {
    clearTiles(tile);
    continueAlong(true, tile, image, max_width, blocks_[member]);
  });
  team.forEach(tile_columns_, [&](std::size_t tile, std::size_t member) {
    continueAlong(false, tile, image, max_width, blocks_[member]);
  });
}

void HiddenSurfaces::clearTiles(std::size_t tile_row)
{
  const std::size_t v_end = std::min<std::size_t>((tile_row + 1) * kTile, cloud_.height);
  for (std::size_t tile = 0; tile < tile_columns_; ++tile) {
    std::uint8_t& has_points = tiles_[tile_row * tile_columns_ + tile];
    if (has_points == 0) {
      continue;
    }
    has_points = 0;
    const std::size_t columns = std::min<std::size_t>(kTile, cloud_.width - tile * kTile);
    for (std::size_t v = tile_row * kTile; v < v_end; ++v) {
      for (auto* coordinate : {&cloud_.x, &cloud_.y, &cloud_.z}) {
        std::fill_n(coordinate->begin() + static_cast<std::ptrdiff_t>(v * cloud_.width + tile * kTile), columns,
                    std::nanf(""));
      }
    }
  }
}

/// Continues the surfaces in the rows (or columns) of a row (or column) of tiles.
void HiddenSurfaces::continueAlong(bool rows, std::size_t tile, const RangeImage& image, double max_width, Block& block)
{
  const Cloud& seen = image.cloud();
  const PinholeIntrinsics& camera = image.intrinsics();
  const std::size_t width = seen.width, height = seen.height;
  const std::size_t size = rows ? width : height, step = rows ? 1 : width;
  const std::size_t begin = tile * kTile, end = std::min(begin + kTile, rows ? height : width);
  const std::size_t lines = (end - begin + kStride - 1) / kStride;

  if (lines < kScanLines) {
    std::fill_n(block.depth.begin(), size * kScanLines, std::nanf(""));
  }
  const float* depth = seen.z.data() + begin * (rows ? width : 1);
  const std::size_t line_step = kStride * (rows ? width : 1);
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t line = 0; line < lines; ++line) {
      block.depth[i * kScanLines + line] = depth[i * step + line * line_step];
    }
  }
  findSurfaceEnds(block.depth.data(), size, block.inverse_depth.data(), block.sums.data(), block.last.data(),
                  block.first.data());

  listPixels(block.last, size, block.left);
  listPixels(block.first, size, block.right);
  for (std::size_t line = 0; line < lines; ++line) {
    const std::size_t across = begin + line * kStride;
    const ScanLine scan_line(block.inverse_depth.data() + line, block.sums.data() + line);
    scan_line.visitBridges(
        block.left[line], block.right[line], max_width, std::abs(rows ? camera.fx : camera.fy),
        [&](const Bridge& bridge) {
          for (int i = bridge.left + 1; i < bridge.right; ++i) {
            const auto along = static_cast<std::size_t>(i);
            const std::size_t u = rows ? along : across, v = rows ? across : along;
            const std::size_t pixel = v * width + u;
            const double z = 1.0 / bridge.line(i);
            if (scan_line.measuredAt(i, bridge.line) || cloud_.z[pixel] >= z) {
              continue;
            }
            cloud_.set(pixel, static_cast<float>((static_cast<double>(u) - camera.cx) / camera.fx * z),
                       static_cast<float>((static_cast<double>(v) - camera.cy) / camera.fy * z), static_cast<float>(z));
            tiles_[v / kTile * tile_columns_ + u / kTile] = 1;
          }
        });
  }
}

Cloud continueSurfaces(const RangeImage& image, double max_width)
{
  ThreadTeam serial(1);
  HiddenSurfaces surfaces;
  surfaces.update(image, max_width, serial);
  return surfaces.cloud();
}

}  // namespace grasp_affordances
