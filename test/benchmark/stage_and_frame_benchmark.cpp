// Times of every stage, per sample and per frame, and of whole frames. Google Benchmark's options choose among them.

#include "benchmark/clouds.h"
#include "benchmark/frame_variants.h"
#include "benchmark/stages.h"

#include <benchmark/benchmark.h>

#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

void registerFrame(const NamedCloud& named, const FrameVariant& variant)
{
  const auto measure = [&named, &variant](benchmark::State& state) {
    const auto run = frameRun(variant, named.cloud);
    run();
    for (auto _ : state) {
      benchmark::DoNotOptimize(run());
    }
  };
  benchmark::RegisterBenchmark(("frame/" + named.name + "/" + variant.name).c_str(), measure)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

void registerStage(const NamedCloud& named, const Stage& stage, Workbench& workbench)
{
  const auto measure = [&stage, &workbench](benchmark::State& state) {
    for (auto _ : state) {
      stage.run(workbench);
    }
  };
  benchmark::RegisterBenchmark(("stage/" + named.name + "/" + stage.name).c_str(), measure)
      ->Unit(benchmark::kMicrosecond);
}

}  // namespace
}  // namespace grasp_affordances::test

int main(int argc, char** argv)
{
  using namespace grasp_affordances::test;
  try {
    const std::vector<NamedCloud> clouds = benchmarkClouds();
    std::vector<std::unique_ptr<Workbench>> workbenches;
    for (const NamedCloud& named : clouds) {
      workbenches.push_back(std::make_unique<Workbench>(named.cloud));
      for (const Stage& stage : stages()) {
        registerStage(named, stage, *workbenches.back());
      }
      for (const FrameVariant& variant : frameVariants()) {
        registerFrame(named, variant);
      }
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
      return 2;
    }
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::cerr << "stage_and_frame_benchmark: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
