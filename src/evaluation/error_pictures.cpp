#include "evaluation/error_pictures.h"

#include "evaluation/close_up.h"
#include "evaluation/parallel.h"
#include "grasp_affordances/parameters.h"
#include "rendering/picture.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr Color kWrong{1.0F, 0.35F, 0.1F};

const Shell& shellOf(const Evaluation& evaluation, const Error& error)
{
  return evaluation.frames[error.frame].runs[error.variation][error.run].shells[error.shell].shell;
}

std::vector<Error> wrongPlaces(const Evaluation& evaluation, std::size_t frame, std::size_t variation)
{
  const double distance = evaluation.frames[frame].capture_radius;
  const auto& runs = evaluation.frames[frame].runs[variation];
  std::vector<Error> places;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    for (std::size_t i = 0; i < runs[run].shells.size(); ++i) {
      const JudgedShell& judged = runs[run].shells[i];
      if (judged.verdict.kind != Verdict::wrong) {
        continue;
      }
      const auto place = std::find_if(places.begin(), places.end(), [&](const Error& other) {
        return (shellOf(evaluation, other).centroid - judged.shell.centroid).norm() < distance;
      });
      if (place != places.end()) {
        ++place->count;
      } else {
        places.push_back({frame, variation, run, 1, false, i, 0});
      }
    }
  }
  return places;
}

std::vector<Error> misses(const Evaluation& evaluation, std::size_t frame, std::size_t variation)
{
  const FrameResult& result = evaluation.frames[frame];
  std::vector<Error> missed;
  for (std::size_t i = 0; i < result.affordances.size(); ++i) {
    const Affordance& affordance = result.affordances[i];
    if (visiblePoints(result, i, evaluation.variations[variation].views) == 0) {
      continue;
    }
    std::optional<Error> error;
    for (std::size_t run = 0; run < result.runs[variation].size(); ++run) {
      if (!finds(result.runs[variation][run], affordance.label)) {
        error = error ? error : Error{frame, variation, run, 0, true, 0, affordance.label};
        ++error->count;
      }
    }
    if (error) {
      missed.push_back(*error);
    }
  }
  return missed;
}

/// Of the affordance missed.
std::size_t affordanceIndex(const Evaluation& evaluation, const Error& error)
{
  const auto& affordances = evaluation.frames[error.frame].affordances;
  const auto found = std::find_if(affordances.begin(), affordances.end(),
                                  [&](const Affordance& affordance) { return affordance.label == error.label; });
  return static_cast<std::size_t>(found - affordances.begin());
}

/// In the views of the variation.
std::size_t visiblePoints(const Evaluation& evaluation, const Error& error)
{
  return visiblePoints(evaluation.frames[error.frame], affordanceIndex(evaluation, error),
                       evaluation.variations[error.variation].views);
}

std::string pictureName(const Evaluation& evaluation, const Error& error)
{
  const FrameResult& frame = evaluation.frames[error.frame];
  const auto& [config, views] = evaluation.variations[error.variation];
  return frame.scene + "-" + std::to_string(frame.seed) + "-" + config.preset + "-" +
         enumWord(config.estimation.estimator) + (views > 1 ? "-" + std::to_string(views) + "-views" : "") +
         (error.is_miss ? "-miss-" : "-wrong-") + std::to_string(error.run + 1) + "-" +
         std::to_string(error.is_miss ? error.label : error.shell);
}

std::string millimetres(double metres)
{
  return std::isfinite(metres) ? std::to_string(std::lround(1000.0 * metres)) + " mm" : "?";
}

void save(const std::string& path, const ColoredCloud& view, const Shell* shell, const std::string& caption)
{
  Picture picture(view.cloud, view.colors);
  if (shell != nullptr) {
    ShellStyle style;
    style.color = kWrong;
    picture.drawShell(*shell, style);
  }
  picture.drawCaption(caption);
  picture.save(path);
}

void drawWrong(const std::string& path, const LabelledCloud& labelled, Shell shell, const std::string& caption,
               const std::string& section_caption)
{
  const std::vector<Color> colors = labelColors(labelled.labels);
  const double radius = 3.0 * std::hypot(shell.length / 2, shell.inner_radius + shell.thickness);
  save(path + ".png", closeUp(labelled.cloud, colors, shell.centroid, radius), &shell, caption);
  const ColoredCloud section = crossSection(labelled.cloud, colors, shell);
  save(path + "-section.png", section, &shell, section_caption);
}

/// Middle and radius of the measured points of an affordance.
std::pair<Eigen::Vector3d, double> surroundingSphere(const LabelledCloud& labelled, std::uint32_t label)
{
  std::vector<Eigen::Vector3d> points;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < labelled.labels.size(); ++i) {
    if (labelled.labels[i] == label && labelled.cloud.measured(i)) {
      points.push_back(labelled.cloud.point(i).cast<double>());
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

void drawMiss(const std::string& path, const LabelledCloud& labelled, std::uint32_t label, const std::string& caption)
{
  constexpr double kSurroundings = 0.06;  // m
  const auto [middle, radius] = surroundingSphere(labelled, label);
  const ColoredCloud view =
      closeUp(labelled.cloud, labelColors(labelled.labels, label), middle, radius + kSurroundings);
  save(path + ".png", view, nullptr, caption);
}

void draw(const std::string& folder, const Evaluation& evaluation, const LabelledCloud& labelled, const Error& error)
{
  const std::string name = pictureName(evaluation, error);
  const std::string path = folder + "/" + name;
  if (error.is_miss) {
    const Affordance& affordance = evaluation.frames[error.frame].affordances[affordanceIndex(evaluation, error)];
    drawMiss(path, labelled, error.label,
             name + ":  " + affordance.object + ", " + std::to_string(visiblePoints(evaluation, error)) +
                 " points, radius " + millimetres(affordance.radius) + ", missed in " + std::to_string(error.count) +
                 " of " + std::to_string(evaluation.runs) + " runs");
    return;
  }
  const Shell& shell = shellOf(evaluation, error);
  drawWrong(path, labelled, shell,
            name + ":  " + std::to_string(error.count) + " wrong here, radius " + millimetres(shell.inner_radius) +
                ", " + std::to_string(shell.points_in_gap) + " points in the gap",
            name + ":  cross-section, sensor above");
}

/// Those of errors that may have been mended since.
void removeErrorPictures(const std::string& folder)
{
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool is_error = name.find("-wrong-") != std::string::npos || name.find("-miss-") != std::string::npos;
    if (is_error && entry.path().extension() == ".png") {
      old.push_back(entry.path());
    }
  }
  for (const std::filesystem::path& path : old) {
    std::filesystem::remove(path);
  }
}

}  // namespace

std::vector<Error> worstErrors(const Evaluation& evaluation, std::size_t limit)
{
  // Per scene, variation and kind, the worst first.
  std::map<std::tuple<std::string, std::size_t, bool>, std::vector<Error>> errors;
  for (std::size_t frame = 0; frame < evaluation.frames.size(); ++frame) {
    for (std::size_t variation = 0; variation < evaluation.variations.size(); ++variation) {
      for (const auto& found : {wrongPlaces(evaluation, frame, variation), misses(evaluation, frame, variation)}) {
        for (const Error& error : found) {
          errors[{evaluation.frames[frame].scene, variation, error.is_miss}].push_back(error);
        }
      }
    }
  }
  const auto weight = [&](const Error& error) {
    return error.is_miss ? visiblePoints(evaluation, error) : error.count;
  };
  std::vector<Error> worst;
  for (auto& [key, candidates] : errors) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](const Error& a, const Error& b) { return weight(a) > weight(b); });
    candidates.resize(std::min(limit, candidates.size()));
    worst.insert(worst.end(), candidates.begin(), candidates.end());
  }
  return worst;
}

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
