// Guards the speed: ratios of times measured in turns within one process, never times, with margins for machines that
// have other work to do.

#include "benchmark/clouds.h"
#include "benchmark/frame_variants.h"
#include "benchmark/interleaved.h"
#include "grasp_affordances/localizer.h"
#include "simulation/scene_library.h"
#include "simulation/sensor.h"
#include "simulation/sensor_model.h"
#include "support/points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

/// A frame takes so many times as long as another, or one of its stages does.
struct Bound
{
  const char* slower;
  const char* faster;
  double StageTimes::*stage;
  double least_ratio;
};

// What docs/performance.md reports, with a margin for other machines, on the rendered cloud, which every checkout has.
constexpr Bound kTextbook{"textbook", "paper", &StageTimes::total, 15.0};
constexpr Bound kTextbookUnfiltered{"textbook/unfiltered", "paper/unfiltered", &StageTimes::total, 20.0};
constexpr Bound kPca{"paper/unfiltered", "paper/unfiltered/pca", &StageTimes::fit, 1.5};

// Two localizers of one thread, at the same time, are as fast as two cores can be just then: a localizer of
// two threads reaches this share of it, which in an idle machine is a speed-up of 1.3.
constexpr double kLeastShareOfTwoLocalizers = 0.65;

// Three million points in any order, without a range image, take at most so many times as long as a range image.
constexpr double kMostUnorganized = 80.0;

// An Xtion renders at 30 frames a second where the others must reach 10; per pixel, as their images differ in size.
constexpr double kSlowestSensor = 3.0;

constexpr int kMostAttempts = 6;  // the best of which counts: what else the machine does can only spoil them
constexpr std::size_t kRepetitions = 9, kTextbookRepetitions = 1;

const Cloud& cloud()
{
  static const std::vector<NamedCloud> clouds = benchmarkClouds();
  return clouds.back().cloud;
}

/// Time of the first over time of the second.
double measuredRatio(const std::vector<RepeatedFrame>& frames, double StageTimes::*stage, double enough)
{
  double best = 0.0;
  for (int attempt = 0; attempt < kMostAttempts && best < enough; ++attempt) {
    const std::vector<StageTimes> medians = interleavedMedians(frames);
    best = std::max(best, medians[0].*stage / (medians[1].*stage));
  }
  return best;
}

void expectRatio(const Bound& bound)
{
  std::vector<RepeatedFrame> frames;
  for (const char* name : {bound.slower, bound.faster}) {
    const FrameVariant& variant = frameVariant(name);
    frames.push_back({frameRun(variant, cloud()), variant.textbook ? kTextbookRepetitions : kRepetitions});
  }
  const double ratio = measuredRatio(frames, bound.stage, bound.least_ratio);
  EXPECT_GE(ratio, bound.least_ratio) << bound.slower << " : " << bound.faster;
}

/// Wall time of two frames at once, by one thread each, per frame.
Localization runPair(const std::function<Localization()>& first, const std::function<Localization()>& second)
{
  const auto start = std::chrono::steady_clock::now();
  std::thread other([&] { second(); });
  Localization result = first();
  other.join();
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
  result.milliseconds.total = elapsed.count() / 2;
  return result;
}

/// Measured points of a cloud, moved by a millimetre at most, as often as it takes, in any order.
Cloud shuffledPoints(const Cloud& cloud, std::size_t count)
{
  Random random(1);
  Points points;
  for (std::size_t i = 0; points.size() < count; i = (i + 1) % cloud.size()) {
    if (cloud.measured(i)) {
      points.push_back(cloud.point(i).cast<double>() + random.uniform(0.0, 0.001) * random.direction());
    }
  }
  for (std::size_t i = count - 1; i > 0; --i) {
    std::swap(points[i], points[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(i + 1)))]);
  }
  return cloudOf(points);
}

class Ratios : public testing::Test
{
protected:
  void SetUp() override
  {
#ifndef NDEBUG
    GTEST_SKIP() << "SKIPPED: built without optimisation";
#endif
  }
};

/// Least wall time of several frames, s per pixel.
double renderingTime(const SensorModel& model, const View& view)
{
  const DepthCamera camera(model);
  double least = std::numeric_limits<double>::infinity();
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    const auto start = std::chrono::steady_clock::now();
    camera.capture(view.scene, view.T_scene_camera, 1);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    least = std::min(least, elapsed.count() / (static_cast<double>(model.width) * model.height));
  }
  return least;
}

TEST_F(Ratios, Sensors)
{
  const View view = makeScene("cleaning2", 1);
  const double xtion = renderingTime(SensorModel(), view);
  for (const std::string& name : sensorNames()) {
    const double ratio = renderingTime(sensorModel(name), view) / xtion;
    std::printf("%-18s %.2f times an xtion, %.1f ms at 640 x 480\n", name.c_str(), ratio,
                1000.0 * 307200.0 * ratio * xtion);
    EXPECT_LE(ratio, kSlowestSensor) << name;
  }
}

TEST_F(Ratios, TextbookPipeline)
{
  expectRatio(kTextbook);
}

TEST_F(Ratios, TextbookPipelineWhereNothingIsFilteredOut)
{
  expectRatio(kTextbookUnfiltered);
}

TEST_F(Ratios, PcaFit)
{
  expectRatio(kPca);
}

TEST_F(Ratios, TwoThreads)
{
  if (std::thread::hardware_concurrency() < 2) {
    GTEST_SKIP() << "SKIPPED: one core";
  }
  const FrameVariant& one_thread = frameVariant("paper/unfiltered");
  const auto first = frameRun(one_thread, cloud()), second = frameRun(one_thread, cloud());
  const std::vector<RepeatedFrame> frames = {
      {[&] { return runPair(first, second); }, kRepetitions},
      {frameRun(frameVariant("paper/unfiltered/2_threads"), cloud()), kRepetitions}};
  EXPECT_GE(measuredRatio(frames, &StageTimes::total, kLeastShareOfTwoLocalizers), kLeastShareOfTwoLocalizers);
}

/// 38 times as long was measured; a search structure that keeps the cloud's order, or that goes back to the cloud for
/// each point, takes 150 to 200 times as long.
TEST_F(Ratios, ThreeMillionUnorganizedPointsInAnyOrder)
{
  constexpr std::size_t kPoints = 3000000;
  const Cloud unordered = shuffledPoints(cloud(), kPoints);
  Localizer of_image, of_points;
  const std::vector<RepeatedFrame> frames = {{[&] { return of_image.localize(cloud()); }, kRepetitions},
                                             {[&] { return of_points.localize(unordered); }, 1}};
  EXPECT_GE(measuredRatio(frames, &StageTimes::total, 1.0 / kMostUnorganized), 1.0 / kMostUnorganized);
}

}  // namespace
}  // namespace grasp_affordances::test
