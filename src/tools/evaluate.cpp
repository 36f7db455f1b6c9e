#include "evaluation/error_pictures.h"
#include "evaluation/evaluation.h"
#include "evaluation/recordings.h"
#include "evaluation/report.h"
#include "evaluation/runtime.h"
#include "tools/evaluate_options.h"
#include "tools/progress.h"

#include <cstdint>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>
#include <vector>

namespace grasp_affordances
{
namespace
{

// Exit statuses.
constexpr int kDone = 0, kFailed = 1, kBadUsage = 2;

void appendRecordings(const EvaluateOptions& options, std::vector<EvaluationFrame>& frames)
{
  for (EvaluationFrame& frame : recordedFrames(options.labels)) {
    if (options.capture_radius) {
      frame.load = [load = std::move(frame.load), radius = *options.capture_radius] {
        LabelledCloud labelled = load();
        labelled.capture_radius = radius;
        return labelled;
      };
    }
    frames.push_back(std::move(frame));
  }
}

void drawPictures(const EvaluateOptions& options, const Evaluation& evaluation,
                  const std::vector<EvaluationFrame>& frames)
{
  const std::vector<Error> errors = worstErrors(evaluation, options.pictures);
  Progress progress("pictures", errors.size());
  drawErrors(options.out + "/pictures", evaluation, frames, errors, options.threads, [&] { progress.step(); });
}

void measureRuntime(const EvaluateOptions& options)
{
  constexpr std::uint64_t kSeed = 101;
  constexpr std::size_t kCalls = 10;  // as in the paper's figure 7
  const std::vector<int> samples{1000, 2000, 3000, 4000, 5000, 6000, 7000, 8000, 9000, 10000};
  std::vector<Config> variations;
  for (const auto& [config, views] : options.variations) {
    if (views == 1) {
      variations.push_back(config);
      variations.back().threads = static_cast<int>(options.threads);
    }
  }
  Progress progress("runtime", variations.size() * samples.size());
  const LabelledCloud labelled = renderedFrame("", "cleaning2", kSeed, GraspDefinition()).load();
  writeRuntimes(options.out, measureRuntimes(labelled.cloud, variations, samples, kCalls, [&] { progress.step(); }));
}

void run(const EvaluateOptions& options)
{
  std::vector<EvaluationFrame> frames = options.frames;
  if (!options.labels.empty()) {
    appendRecordings(options, frames);
  }
  std::filesystem::create_directories(options.out);
  for (const char* table : {"/runtime.csv", "/samples.csv"}) {
    std::filesystem::remove(options.out + table);  // of an earlier call, which plots would show as measured now
  }
  Evaluation evaluation{options.variations, options.runs, {}};
  {
    Progress progress("frames", frames.size());
    evaluation.frames = evaluate(frames, options.variations, options.runs, options.threads, [&] { progress.step(); });
  }
  const std::vector<SummaryRow> rows = summarize(evaluation);
  writeReport(options.out, evaluation, rows);
  drawPictures(options, evaluation, frames);
  if (options.runtime) {
    measureRuntime(options);
  }
  std::cout << markdownTables(evaluation, rows);
}

int evaluateMain(int argc, char** argv)
{
  std::optional<EvaluateOptions> options;
  try {
    options = parseEvaluateOptions(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "evaluate: " << error.what() << "\n";
    return kBadUsage;
  }
  try {
    if (options && options->suite) {
      evaluateSuite(*options->suite);
    } else if (options) {
      run(*options);
    }
  } catch (const std::exception& error) {
    std::cerr << "evaluate: " << error.what() << "\n";
    return kFailed;
  }
  if (!std::cout.flush()) {
    std::cerr << "evaluate: cannot write to stdout\n";
    return kFailed;
  }
  return kDone;
}

}  // namespace
}  // namespace grasp_affordances

int main(int argc, char** argv)
{
  return grasp_affordances::evaluateMain(argc, argv);
}
