// frame_ratios: times of whole frames, of all variants and the textbook pipeline in turns, and their ratios; as JSON.

#include "benchmark/clouds.h"
#include "benchmark/frame_variants.h"
#include "benchmark/interleaved.h"
#include "grasp_affordances/parameters.h"
#include "tools/json.h"

#include <CLI/CLI.hpp>

#include <cstddef>
#include <exception>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

/// The frames whose times are compared: slower, faster.
constexpr std::pair<const char*, const char*> kRatios[] = {{"textbook", "paper"},
                                                           {"textbook/unfiltered", "paper/unfiltered"},
                                                           {"textbook/48_mm", "paper/48_mm"},
                                                           {"textbook/500_nearest", "paper/500_nearest"},
                                                           {"textbook/pca", "paper/pca"},
                                                           {"textbook/normals", "paper/normals"},
                                                           {"paper", "paper/2_threads"},
                                                           {"localizer", "localizer/2_threads"},
                                                           {"paper/pca", "paper"},
                                                           {"paper/normals", "paper"},
                                                           {"localizer/pca", "localizer"},
                                                           {"localizer/normals", "localizer"},
                                                           {"paper/sparse_normals", "paper"},
                                                           {"paper/unfiltered/sparse_normals", "paper/unfiltered"},
                                                           {"localizer/sparse_normals", "localizer"}};

struct Repetitions
{
  std::size_t localizer = 15;
  std::size_t textbook = 3;
};

Json configJson(const FrameVariant& variant)
{
  const Config& config = variant.config;
  return {{"pipeline", variant.textbook ? "textbook" : config.preset},
          {"estimator", enumWord(config.estimation.estimator)},
          {"neighborhood", enumWord(config.neighborhood.kind)},
          {"occlusion_filter", config.occlusion.filter},
          {"capture_radius", config.hand.capture_radius},
          {"samples", config.sampling.samples},
          {"threads", config.threads}};
}

Json stagesJson(const StageTimes& milliseconds)
{
  return {{"preparation", milliseconds.preparation},
          {"neighborhoods", milliseconds.neighborhoods},
          {"occlusion", milliseconds.occlusion},
          {"fit", milliseconds.fit},
          {"shell", milliseconds.shell}};
}

Json measure(const NamedCloud& named, const Repetitions& repetitions)
{
  const std::vector<FrameVariant>& variants = frameVariants();
  std::vector<Localization> results(variants.size());
  std::vector<RepeatedFrame> frames;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    frames.push_back({[run = frameRun(variants[i], named.cloud), &result = results[i]] { return result = run(); },
                      variants[i].textbook ? repetitions.textbook : repetitions.localizer});
  }
  const std::vector<StageTimes> medians = interleavedMedians(frames, [&](std::size_t done, std::size_t rounds) {
    std::cerr << '\r' << named.name << ": round " << done << " of " << rounds << (done < rounds ? "" : "\n");
  });

  Json frames_json;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    Json frame = configJson(variants[i]);
    frame["milliseconds"] = medians[i].total;
    frame["microseconds_per_sample"] = 1e3 * medians[i].total / results[i].sampled;
    frame["stages"] = stagesJson(medians[i]);
    frame["shells"] = results[i].shells.size();
    frames_json[variants[i].name] = frame;
  }
  Json ratios;
  for (const auto& [slower, faster] : kRatios) {
    ratios[std::string(slower) + " : " + faster] =
        frames_json[slower]["milliseconds"].get<double>() / frames_json[faster]["milliseconds"].get<double>();
  }
  return {{"points", results.front().points}, {"frames", frames_json}, {"ratios", ratios}};
}

int run(int argc, char** argv)
{
  CLI::App app("Median times of frames, of all variants and the textbook pipeline in turns, as JSON on stdout.");
  Repetitions repetitions;
  app.add_option("--repetitions", repetitions.localizer, "of each variant")->check(CLI::Range(1, 10000));
  app.add_option("--textbook-repetitions", repetitions.textbook, "of the textbook pipeline")
      ->check(CLI::Range(1, 10000));
  CLI11_PARSE(app, argc, argv);
  Json clouds;
  for (const NamedCloud& named : benchmarkClouds()) {
    clouds[named.name] = measure(named, repetitions);
  }
  std::cout << clouds.dump(1) << std::endl;
  return std::cout ? 0 : 1;
}

}  // namespace
}  // namespace grasp_affordances::test

int main(int argc, char** argv)
{
  try {
    return grasp_affordances::test::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "frame_ratios: " << error.what() << '\n';
    return 1;
  }
}
