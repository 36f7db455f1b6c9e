#pragma once

#include "evaluation/evaluation.h"
#include "evaluation/judge.h"
#include "evaluation/labelled_cloud.h"
#include "evaluation/summary.h"
#include "support/points.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace grasp_affordances::test
{

using Labels = std::vector<std::uint32_t>;

/// About the z axis: inner radius 2 cm, length 4 cm.
inline Shell makeShell()
{
  Shell shell;
  shell.inner_radius = 0.02;
  shell.thickness = 0.008;
  shell.length = 0.04;
  return shell;
}

/// A bumpy wall before a pinhole camera, with holes.
inline Cloud makeOrganizedCloud(Random& random)
{
  const PinholeIntrinsics k{130.0, 130.0, 79.5, 59.5};
  Cloud cloud;
  cloud.reset(160, 120);
  cloud.intrinsics = k;
  for (std::uint32_t v = 0, i = 0; v < cloud.height; ++v) {
    for (std::uint32_t u = 0; u < cloud.width; ++u, ++i) {
      const double z = random.uniform(0.0, 1.0) < 0.1 ? std::nan("") : random.uniform(0.6, 0.7);
      cloud.set(i, static_cast<float>((u - k.cx) / k.fx * z), static_cast<float>((v - k.cy) / k.fy * z),
                static_cast<float>(z));
    }
  }
  return cloud;
}

inline JudgedShell judged(Verdict::Kind kind, std::uint32_t affordance = 0, double x = 0.0)
{
  Shell shell = makeShell();
  shell.centroid.x() = x;
  return {shell, {kind, affordance}};
}

inline Affordance makeAffordance(std::uint32_t label, std::size_t visible_points, double occluded_share)
{
  Affordance affordance;
  affordance.label = label;
  affordance.object = "object " + std::to_string(label);
  affordance.visible_points = visible_points;
  affordance.occluded_share = occluded_share;
  return affordance;
}

inline FrameResult makeFrame(const std::string& scene, std::uint64_t seed)
{
  FrameResult frame;
  frame.group = "paper";
  frame.scene = scene;
  frame.seed = seed;
  frame.points = 1000;
  return frame;
}

/// Taubin and PCA, each with two runs on two frames of one scene.
inline Evaluation makeEvaluation()
{
  Evaluation evaluation;
  evaluation.runs = 2;
  evaluation.variations.resize(2);
  evaluation.variations[1].config.estimation.estimator = Estimator::pca;
  FrameResult first = makeFrame("mugs", 1);
  first.affordances = {makeAffordance(1, 900, 0.1), makeAffordance(2, 100, 0.9)};
  first.runs = {{{{judged(Verdict::right, 1), judged(Verdict::right, 2), judged(Verdict::not_counted)}, 10},
                 {{judged(Verdict::right, 1), judged(Verdict::wrong, 0, 0.5)}, 10}},
                {{{}, 10}, {{judged(Verdict::right, 1), judged(Verdict::wrong)}, 10}}};
  FrameResult second = makeFrame("mugs", 2);
  second.affordances = {makeAffordance(1, 300, 0.6)};
  second.runs = {{{{}, 10}, {{}, 10}}, {{{}, 10}, {{}, 10}}};
  evaluation.frames = {first, second};
  return evaluation;
}

/// A bar before nothing.
inline EvaluationFrame barFrame(std::uint64_t seed)
{
  return {"", "bar", seed, [seed] {
            Random random(seed);
            LabelledCloud labelled;
            labelled.cloud = cloudOf(transformed(cylinderPoints(0.012, 2.5, 0.1, 2000, random),
                                                 Eigen::Matrix3d::Identity(), {0.0, 0.0, 0.8}));
            labelled.labels.assign(labelled.cloud.size(), 1);
            labelled.affordances = {makeAffordance(1, 2000, 0.0), makeAffordance(2, 0, 1.0)};
            labelled.capture_radius = 0.026;
            return labelled;
          }};
}

inline Config fewSamples()
{
  Config config = presetConfig("paper");
  config.sampling.samples = 50;
  return config;
}

}  // namespace grasp_affordances::test
