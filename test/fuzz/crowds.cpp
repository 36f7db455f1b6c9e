#include "fuzz/crowds.h"

#include "fuzz/cpu_time.h"
#include "fuzz/targets.h"
#include "grasp_affordances/localizer.h"
#include "grasp_affordances/parameters.h"

#include <cmath>
#include <cstdio>
#include <random>

namespace grasp_affordances::fuzz
{
namespace
{

constexpr std::uint32_t kPoints = 10000;

struct Crowd
{
  const char* name;
  Eigen::Vector3f (*point)(std::uint32_t i, std::mt19937& random);
};

float uniform(std::mt19937& random)
{
  return std::uniform_real_distribution<float>(-1.0F, 1.0F)(random);
}

constexpr Crowd kCrowds[] = {
    {"place", [](std::uint32_t, std::mt19937&) { return Eigen::Vector3f(0.0F, 0.0F, 1.0F); }},
    {"two places",
     [](std::uint32_t i, std::mt19937&) { return Eigen::Vector3f(0.005F * static_cast<float>(i % 2), 0.0F, 1.0F); }},
    {"line", [](std::uint32_t i, std::mt19937&) { return Eigen::Vector3f(0.0F, 1e-5F * static_cast<float>(i), 1.0F); }},
    {"plane",
     [](std::uint32_t, std::mt19937& random) {
       const float x = uniform(random);
       return Eigen::Vector3f(0.025F * x, 0.025F * uniform(random), 1.0F);
     }},
    {"cube",
     [](std::uint32_t, std::mt19937& random) {
       const float x = uniform(random), y = uniform(random);
       return Eigen::Vector3f(0.01F * x, 0.01F * y, 1.0F + 0.01F * uniform(random));
     }},
    {"cylinder",
     [](std::uint32_t i, std::mt19937&) {
       const float angle = 2.3999632F * static_cast<float>(i);
       return Eigen::Vector3f(0.02F * std::cos(angle), 1e-4F * static_cast<float>(i % 1000),
                              1.0F + 0.02F * std::sin(angle));
     }},
};

}  // namespace

void runCrowds()
{
  for (const Crowd& crowd : kCrowds) {
    constexpr std::uint32_t kSeed = 1;
    std::mt19937 random(kSeed);
    Cloud cloud;
    cloud.reset(kPoints, 1);
    for (std::uint32_t i = 0; i < kPoints; ++i) {
      const Eigen::Vector3f point = crowd.point(i, random);
      cloud.set(i, point.x(), point.y(), point.z());
    }
    for (const Estimator estimator : {Estimator::taubin, Estimator::pca, Estimator::normals}) {
      for (const NeighborhoodKind kind : {NeighborhoodKind::radius, NeighborhoodKind::knn}) {
        Config config;
        config.threads = 1;
        config.estimation.estimator = estimator;
        config.neighborhood.kind = kind;
        const double start = threadCpuSeconds();
        Localizer(config).localize(cloud);
        const double seconds = threadCpuSeconds() - start;
        std::printf("crowd: %s, %s, %s %.3f s\n", crowd.name, enumWord(estimator).c_str(), enumWord(kind).c_str(),
                    seconds);
        require(seconds < longestSeconds(), "a crowd takes at most a second of processor time");
      }
    }
  }
}

}  // namespace grasp_affordances::fuzz
