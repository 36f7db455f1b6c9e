#include "evaluation/error_pictures.h"

#include "evaluation/close_up.h"
#include "evaluation/parallel.h"
#include "evaluation/report_format.h"
#include "rendering/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <optional>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr Color kWrong{1.0F, 0.35F, 0.1F};
constexpr std::array<Color, 4> kHandleColors{
    {{0.1F, 0.6F, 1.0F}, {1.0F, 0.6F, 0.1F}, {0.9F, 0.9F, 0.2F}, {0.6F, 0.3F, 1.0F}}};
constexpr std::array<const char*, 5> kKindNames{"wrong", "miss", "wrong-handle", "no-handle", "several-handles"};

const Run& runOf(const Evaluation& evaluation, const Error& error)
{
  return evaluation.frames[error.frame].runs[error.variation][error.run];
}

/// The last part of a picture's name.
std::string identifier(const Evaluation& evaluation, const Error& error)
{
  switch (error.kind) {
    case Error::wrong_shell:
      return std::to_string(error.index);
    case Error::wrong_handle:
      return std::to_string(runOf(evaluation, error).handles[error.index].handle.id);
    default:
      return std::to_string(error.label);
  }
}

std::string millimetres(double metres)
{
  return std::isfinite(metres) ? std::to_string(std::lround(1000.0 * metres)) + " mm" : "?";
}

std::string affordanceCaption(const Evaluation& evaluation, const Error& error)
{
  const FrameResult& frame = evaluation.frames[error.frame];
  const std::size_t index = affordanceIndex(frame, error);
  const Affordance& affordance = frame.affordances[index];
  const std::size_t points = visiblePoints(frame, index, evaluation.variations[error.variation].views);
  const std::string what = error.kind == Error::miss        ? "missed"
                           : error.kind == Error::no_handle ? "shells but no handle"
                                                            : "several handles";
  return affordance.object + ", " + std::to_string(points) + " points, radius " + millimetres(affordance.radius) +
         ", " + what + " in " + std::to_string(error.count) + " of " + std::to_string(evaluation.runs) + " runs";
}

}  // namespace

const char* errorKindName(Error::Kind kind)
{
  return kKindNames[kind];  // cppcheck-suppress CastIntegerToAddressAtReturn; not an integer
}

std::string pictureName(const Evaluation& evaluation, const Error& error)
{
  const FrameResult& frame = evaluation.frames[error.frame];
  const auto& [config, views] = evaluation.variations[error.variation];
  std::string name = frame.scene + "-" + std::to_string(frame.seed) + "-" + config.preset + "-" + estimatorName(config);
  if (variesSampling(evaluation)) {
    name += "-" + std::to_string(config.sampling.samples) + "-samples-" + onOrOff(config.sampling.importance);
  }
  return name + (views > 1 ? "-" + std::to_string(views) + "-views" : "") + "-" + kKindNames[error.kind] + "-" +
         std::to_string(error.run + 1) + "-" + identifier(evaluation, error);
}

std::string pictureCaption(const Evaluation& evaluation, const Error& error)
{
  const Run& run = runOf(evaluation, error);
  const std::string wrong_here = std::to_string(error.count) + " wrong here, radius ";
  if (error.kind == Error::wrong_shell) {
    const Shell& shell = run.shells[error.index].shell;
    return wrong_here + millimetres(shell.inner_radius) + ", " + std::to_string(shell.points_in_gap) +
           " points in the gap";
  }
  if (error.kind == Error::wrong_handle) {
    const GraspHandle& handle = run.handles[error.index].handle;
    return wrong_here + millimetres(handle.inner_radius) + ", " + std::to_string(handle.shells.size()) + " shells";
  }
  return affordanceCaption(evaluation, error);
}

namespace
{

void drawHandle(Picture& picture, const GraspHandle& handle, const Color& color)
{
  BodyStyle style;
  style.color = color;
  style.fill_opacity = 0.2;
  style.line_width = 2.0;
  picture.drawTube(handle.polyline, handle.inner_radius, style);
}

void save(Picture& picture, const std::string& path, const std::string& caption)
{
  picture.drawCaption(caption);
  picture.save(path);
}

void saveWithShell(const std::string& path, const ColoredCloud& view, const Shell& shell, const std::string& caption)
{
  Picture picture(view.cloud, view.colors);
  ShellStyle style;
  style.color = kWrong;
  picture.drawShell(shell, style);
  save(picture, path, caption);
}

void drawWrongShell(const std::string& path, const LabelledCloud& labelled, Shell shell, const std::string& caption,
                    const std::string& section_caption)
{
  const std::vector<Color> colors = labelColors(labelled.labels);
  const double radius = 3.0 * std::hypot(shell.length / 2, shell.inner_radius + shell.thickness);
  saveWithShell(path + ".png", closeUp(labelled.cloud, colors, shell.centroid, radius), shell, caption);
  const ColoredCloud section = crossSection(labelled.cloud, colors, shell);
  saveWithShell(path + "-section.png", section, shell, section_caption);
}

void drawWrongHandle(const std::string& path, const LabelledCloud& labelled, const GraspHandle& handle,
                     const std::string& caption)
{
  const double radius = 2.0 * (handle.length / 2 + handle.inner_radius);
  const ColoredCloud view = closeUp(labelled.cloud, labelColors(labelled.labels), handle.centroid, radius);
  Picture picture(view.cloud, view.colors);
  drawHandle(picture, handle, kWrong);
  save(picture, path + ".png", caption);
}

/// Middle and radius of the measured points of an affordance.
std::pair<Eigen::Vector3d, double> surroundingSphere(const LabelledCloud& labelled, std::uint32_t label)
{
  std::vector<Eigen::Vector3d> points;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < labelled.labels.size(); ++i) {
    if (labelled.labels[i] == label && labelled.cloud.measured(i)) {
      points.emplace_back(labelled.cloud.point(i).cast<double>());
      sum += points.back();
    }
  }
  const Eigen::Vector3d middle = sum / static_cast<double>(points.size());
  double radius = 0.0;
  for (const Eigen::Vector3d& point : points) {
    radius = std::max(radius, (point - middle).norm());
  }
  return {middle, radius};
}

/// Right shells of an affordance without a handle, faint.
void drawShellsOn(Picture& picture, const Run& run, std::uint32_t label)
{
  ShellStyle style;
  style.color = kHandleColors.front();
  style.fill_opacity = 0.0;
  style.line_width = 1.0;
  style.gap = false;
  for (const JudgedShell& judged : run.shells) {
    if (judged.verdict.affordance == label) {
      picture.drawShell(judged.shell, style);
    }
  }
}

void drawHandlesOn(Picture& picture, const Run& run, std::uint32_t label)
{
  std::size_t drawn = 0;
  for (const JudgedHandle& judged : run.handles) {
    if (judged.verdict.affordance == label) {
      drawHandle(picture, judged.handle, kHandleColors[drawn++ % kHandleColors.size()]);
    }
  }
}

void drawAffordance(const std::string& path, const LabelledCloud& labelled, const Run& run, const Error& error,
                    const std::string& caption)
{
  constexpr double kSurroundings = 0.06;  // m
  const auto [middle, radius] = surroundingSphere(labelled, error.label);
  const ColoredCloud view =
      closeUp(labelled.cloud, labelColors(labelled.labels, error.label), middle, radius + kSurroundings);
  Picture picture(view.cloud, view.colors);
  if (error.kind == Error::no_handle) {
    drawShellsOn(picture, run, error.label);
  }
  drawHandlesOn(picture, run, error.label);
  save(picture, path + ".png", caption);
}

void draw(const std::string& folder, const Evaluation& evaluation, const LabelledCloud& labelled, const Error& error)
{
  const std::string name = pictureName(evaluation, error);
  const std::string path = folder + "/" + name;
  const std::string caption = name + ":  " + pictureCaption(evaluation, error);
  const Run& run = runOf(evaluation, error);
  if (error.kind == Error::wrong_shell) {
    drawWrongShell(path, labelled, run.shells[error.index].shell, caption, name + ":  cross-section, sensor above");
  } else if (error.kind == Error::wrong_handle) {
    drawWrongHandle(path, labelled, run.handles[error.index].handle, caption);
  } else {
    drawAffordance(path, labelled, run, error, caption);
  }
}

/// Those of errors that may have been mended since.
void removeErrorPictures(const std::string& folder)
{
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool is_error = std::any_of(kKindNames.begin(), kKindNames.end(), [&](const std::string& kind) {
      return name.find("-" + kind + "-") != std::string::npos;
    });
    if (is_error && entry.path().extension() == ".png") {
      old.push_back(entry.path());
    }
  }
  for (const std::filesystem::path& path : old) {
    std::filesystem::remove(path);
  }
}

}  // namespace

void drawErrors(const std::string& folder, const Evaluation& evaluation, const std::vector<EvaluationFrame>& frames,
                const std::vector<Error>& errors, std::size_t threads, const std::function<void()>& done)
{
  std::filesystem::create_directories(folder);
  removeErrorPictures(folder);
  std::mutex mutex;
  forEachInParallel(frames.size(), threads, [&](std::size_t frame) {
    std::optional<LabelledCloud> labelled;
    for (const Error& error : errors) {
      if (error.frame != frame) {
        continue;
      }
      if (!labelled) {
        labelled = frames[frame].load();
      }
      const std::size_t views = evaluation.variations[error.variation].views;
      draw(folder, evaluation, views > 1 ? united(*labelled, views) : *labelled, error);
      const std::lock_guard<std::mutex> lock(mutex);
      done();
    }
  });
}

}  // namespace grasp_affordances
