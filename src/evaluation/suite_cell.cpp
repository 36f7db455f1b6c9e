#include "evaluation/suite_cell.h"

#include "evaluation/error_causes.h"
#include "evaluation/error_pictures.h"
#include "evaluation/evaluation.h"
#include "evaluation/recordings.h"
#include "evaluation/suite_numbers.h"
#include "grasp_affordances/parameters.h"

#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace grasp_affordances
{
namespace
{

using Json = nlohmann::json;

std::vector<Variation> variationsOf(const SuiteCell& cell, const std::string& config_file)
{
  std::vector<Variation> variations;
  for (const std::string& preset : cell.presets) {
    Config config = presetConfig(preset);
    if (!config_file.empty()) {
      config = configFromYamlFile(config_file, config);
    }
    config.estimation.estimator = Estimator::taubin;
    config.hand.capture_radius = cell.capture_radius;
    validate(config);
    variations.push_back({config, 1});
  }
  return variations;
}

Json millimetres(double metres)
{
  return std::isfinite(metres) ? Json(std::round(1e4 * metres) / 10.0) : Json();
}

bool isOfAffordance(const Error& error)
{
  return error.label != 0;
}

/// Errors of affordances that the tables do not count are left out.
bool isCounted(const Evaluation& evaluation, const Error& error)
{
  const FrameResult& frame = evaluation.frames[error.frame];
  return !isOfAffordance(error) || isCounted(frame.affordances[affordanceIndex(frame, error)]);
}

Json errorJson(const Evaluation& evaluation, const Error& error, bool is_drawn)
{
  const FrameResult& frame = evaluation.frames[error.frame];
  Json json{{"kind", errorKindName(error.kind)},
            {"cause", causeOf(evaluation, error)},
            {"scene", frame.scene},
            {"seed", frame.seed},
            {"run", error.run + 1},
            {"runs", error.count},
            {"what", pictureCaption(evaluation, error)}};
  if (isOfAffordance(error)) {
    const Affordance& affordance = frame.affordances[affordanceIndex(frame, error)];
    json["affordance"] = affordance.object.empty() ? "label " + std::to_string(error.label) : affordance.object;
    json["points"] = affordance.visible_points;
    json["radius_mm"] = millimetres(affordance.radius);
    json["ends"] = endsJson(endsOn(evaluation, error));
  }
  if (is_drawn) {
    json["picture"] = pictureName(evaluation, error) + ".png";
  }
  return json;
}

/// Of one variation.
Json errorsJson(const Evaluation& evaluation, std::size_t variation, const std::vector<Error>& errors,
                const std::set<std::string>& drawn)
{
  Json list = Json::array();
  for (const Error& error : errors) {
    if (error.variation == variation && isCounted(evaluation, error)) {
      list.push_back(errorJson(evaluation, error, drawn.count(pictureName(evaluation, error)) > 0));
    }
  }
  return list;
}

std::vector<const FrameResult*> framesOfScene(const Evaluation& evaluation, const std::string& scene)
{
  std::vector<const FrameResult*> frames;
  for (const FrameResult& frame : evaluation.frames) {
    if (scene.empty() || frame.scene == scene) {
      frames.push_back(&frame);
    }
  }
  return frames;
}

/// By scene, in the order of the frames.
Json scenesJson(const Evaluation& evaluation, std::size_t variation)
{
  Json scenes = Json::array();
  std::set<std::string> known;
  for (const FrameResult& frame : evaluation.frames) {
    if (known.insert(frame.scene).second) {
      scenes.push_back(numbersJson(framesOfScene(evaluation, frame.scene), variation));
      scenes.back()["scene"] = frame.scene;
    }
  }
  return scenes;
}

/// Those of affordances that the tables count, and all wrong ones.
std::vector<Error> countedErrors(const Evaluation& evaluation, std::size_t limit)
{
  std::vector<Error> counted;
  for (const Error& error : worstErrors(evaluation, limit)) {
    if (isCounted(evaluation, error)) {
      counted.push_back(error);
    }
  }
  return counted;
}

}  // namespace

std::vector<EvaluationFrame> framesOf(const SuiteCell& cell)
{
  if (cell.recorded()) {
    return recordedFrames(cell.labels);
  }
  GraspDefinition definition;
  definition.capture_radius = cell.capture_radius;
  definition.clearance = presetConfig(cell.presets.front()).hand.finger_thickness;
  const SensorModel sensor = sensorModelFromNameOrFile(cell.sensor);
  const Background background = backgroundFromName(cell.background);
  std::vector<EvaluationFrame> frames;
  for (const std::string& scene : cell.scenes) {
    for (const std::uint64_t seed : cell.seeds) {
      frames.push_back(renderedFrame(cell.row, scene, seed, definition, {0.0}, sensor, background));
    }
  }
  return frames;
}

Json evaluateCell(const SuiteCell& cell, const std::string& config_file, const std::string& pictures,
                  std::size_t threads, const std::function<void()>& done)
{
  const std::vector<EvaluationFrame> frames = framesOf(cell);
  Evaluation evaluation{variationsOf(cell, config_file), cell.runs, {}};
  evaluation.frames = evaluate(frames, evaluation.variations, cell.runs, threads, done);
  const std::vector<Error> to_draw = countedErrors(evaluation, cell.pictures);
  drawErrors(pictures, evaluation, frames, to_draw, threads, [] {});
  std::set<std::string> drawn;
  for (const Error& error : to_draw) {
    drawn.insert(pictureName(evaluation, error));
  }
  const std::vector<Error> errors = countedErrors(evaluation, std::numeric_limits<std::size_t>::max());
  Json results = Json::array();
  for (std::size_t variation = 0; variation < evaluation.variations.size(); ++variation) {
    Json result = numbersJson(framesOfScene(evaluation, ""), variation);
    result["preset"] = evaluation.variations[variation].config.preset;
    result["samples"] = evaluation.variations[variation].config.sampling.samples;
    result["scenes"] = scenesJson(evaluation, variation);
    result["errors"] = errorsJson(evaluation, variation, errors, drawn);
    results.push_back(result);
  }
  return results;
}

Json cellDescription(const SuiteCell& cell)
{
  return {{"row", cell.row},          {"sensor", cell.sensor}, {"background", cell.background},
          {"presets", cell.presets},  {"scenes", cell.scenes}, {"capture_radius", cell.capture_radius},
          {"seeds", cell.seeds},      {"labels", cell.labels}, {"runs", cell.runs},
          {"pictures", cell.pictures}};
}

}  // namespace grasp_affordances
