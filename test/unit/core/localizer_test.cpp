#include "grasp_affordances/localizer.h"

#include "core/kernels/instruction_sets.h"
#include "evaluation/judge.h"
#include "simulation/tableware.h"
#include "support/points.h"
#include "support/scenes.h"
#include "support/shells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <string>

namespace grasp_affordances::test
{
namespace
{

void expectSound(const Localization& result, const std::string& what)
{
  EXPECT_EQ(std::accumulate(result.counts.begin(), result.counts.end(), 0U), result.sampled) << what;
  EXPECT_EQ(result.counts[static_cast<std::size_t>(Outcome::shell)], result.shells.size()) << what;
  for (const Shell& shell : result.shells) {
    EXPECT_TRUE(shell.centroid.allFinite() && shell.axis.allFinite() && shell.normal.allFinite()) << what;
    EXPECT_NEAR(shell.axis.norm(), 1.0, 1e-9) << what;
    EXPECT_NEAR(shell.normal.norm(), 1.0, 1e-9) << what;
    EXPECT_NEAR(shell.axis.dot(shell.normal), 0.0, 1e-9) << what;
    EXPECT_GT(shell.axis.maxCoeff(), -shell.axis.minCoeff()) << what << ": largest component positive";
    EXPECT_TRUE(std::isfinite(shell.inner_radius) && std::isfinite(shell.length)) << what;
    EXPECT_TRUE(std::isnan(shell.curvature) || (std::isfinite(shell.curvature) && shell.curvature > 0.0)) << what;
    EXPECT_TRUE(std::isnan(shell.observed_free) || (shell.observed_free >= 0.0 && shell.observed_free <= 1.0)) << what;
  }
}

std::uint32_t count(const Localization& result, Outcome outcome)
{
  return result.counts[static_cast<std::size_t>(outcome)];
}

struct Variation
{
  std::string preset;
  Estimator estimator;
  NeighborhoodKind kind;
};

class EveryVariation : public testing::TestWithParam<Variation>
{
protected:
  Config config() const
  {
    Config config = presetConfig(GetParam().preset);
    config.estimation.estimator = GetParam().estimator;
    config.neighborhood.kind = GetParam().kind;
    return config;
  }
};

TEST_P(EveryVariation, FindsTheSameWithAnyNumberOfThreads)
{
  const Cloud cloud = captureScene("table", 1).cloud;
  Config config = this->config();
  config.sampling.samples = 1000;
  config.threads = 1;
  const Localization reference = Localizer(config).localize(cloud);
  expectSound(reference, "one thread");
  EXPECT_EQ(reference.sampled, 1000U);
  for (const int threads : {1, 2, 3, 8}) {
    config.threads = threads;
    Localizer localizer(config);
    for (int run = 0; run < 2; ++run) {
      const Localization result = localizer.localize(cloud);
      EXPECT_LE(result.threads, static_cast<std::uint32_t>(threads));
      ASSERT_EQ(result.counts, reference.counts) << threads << " threads, run " << run;
      for (std::size_t i = 0; i < result.shells.size(); ++i) {
        ASSERT_TRUE(same(result.shells[i], reference.shells[i])) << threads << " threads, run " << run;
      }
    }
  }
}

TEST_P(EveryVariation, FindsTheSameWithEveryInstructionSet)
{
  const Cloud cloud = captureScene("cleaning2", 1).cloud;
  Config config = this->config();
  config.sampling.samples = 1000;
  Localizer localizer(config);
  const Localization reference = localizer.localize(cloud);
  ASSERT_GT(reference.shells.size(), 0U);
  for (const std::string& name : instructionSets()) {
    useInstructionSet(name);
    const Localization result = localizer.localize(cloud);
    ASSERT_EQ(result.counts, reference.counts) << name;
    for (std::size_t i = 0; i < result.shells.size(); ++i) {
      ASSERT_TRUE(same(result.shells[i], reference.shells[i])) << name;
    }
  }
  useInstructionSet("");
}

TEST_P(EveryVariation, AnswersDegenerateClouds)
{
  Random random(1);
  Points plane, line, sheets, twins;
  for (int i = 0; i < 3000; ++i) {
    const double x = random.uniform(-0.1, 0.1), y = random.uniform(-0.1, 0.1);
    plane.emplace_back(x, y, 1.0);
    line.emplace_back(x, 0.5 * x, 1.0 + x);
    sheets.emplace_back(x, y, i % 2 == 0 ? 1.0 : 1.0 + 0x1p-8);
    twins.emplace_back(i % 2 == 0 ? 0.0 : 0.1, 0.0, 1.0);
  }
  Config config = this->config();
  config.sampling.samples = 100;
  Localizer localizer(config);
  for (const auto& [name, points] : {std::pair<std::string, Points>{"plane", plane},
                                     {"line", line},
                                     {"twins", twins},
                                     {"sheets", sheets},
                                     {"one point", {{0, 0, 1}}},
                                     {"two points", {{0, 0, 1}, {0, 0.01, 1}}}}) {
    const Localization result = localizer.localize(cloudOf(points));
    expectSound(result, name);
    if (config.estimation.estimator == Estimator::taubin) {
      EXPECT_TRUE(result.shells.empty()) << name;
    }
    EXPECT_FALSE(result.warnings.empty()) << name << ": not organized";
  }
}

INSTANTIATE_TEST_SUITE_P(Localizer, EveryVariation,
                         testing::Values(Variation{"localizer", Estimator::taubin, NeighborhoodKind::radius},
                                         Variation{"paper", Estimator::taubin, NeighborhoodKind::radius},
                                         Variation{"paper", Estimator::taubin, NeighborhoodKind::knn},
                                         Variation{"paper", Estimator::pca, NeighborhoodKind::knn},
                                         Variation{"localizer", Estimator::pca, NeighborhoodKind::radius},
                                         Variation{"paper", Estimator::pca, NeighborhoodKind::radius},
                                         Variation{"paper", Estimator::normals, NeighborhoodKind::knn},
                                         Variation{"paper", Estimator::normals, NeighborhoodKind::radius}),
                         [](const testing::TestParamInfo<Variation>& info) {
                           return info.param.preset + "_" +
                                  std::string(info.param.estimator == Estimator::taubin ? "taubin"
                                              : info.param.estimator == Estimator::pca  ? "pca"
                                                                                        : "normals") +
                                  (info.param.kind == NeighborhoodKind::knn ? "_knn" : "_radius");
                         });

TEST(Localizer, CountsExactlyCoplanarNeighborhoodsAsDegenerate)
{
  Random random(1);
  Points plane;
  for (int i = 0; i < 3000; ++i) {
    plane.emplace_back(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 1.0);
  }
  const Localization result = Localizer(presetConfig("paper")).localize(cloudOf(plane));
  EXPECT_EQ(count(result, Outcome::degenerate), result.sampled);
}

TEST(Localizer, FitsNeighborhoodsOfTheLeastNumberOfPoints)
{
  constexpr int kPoints = 30;
  Random random(1);
  Points near;
  for (int i = 0; i < kPoints; ++i) {
    near.emplace_back(random.uniform(-0.005, 0.005), random.uniform(-0.005, 0.005), random.uniform(1.0, 1.005));
  }
  Config config = presetConfig("paper");
  config.sampling.samples = 20;
  config.neighborhood.min_points = kPoints;
  EXPECT_EQ(count(Localizer(config).localize(cloudOf(near)), Outcome::too_few_points), 0U);
  config.neighborhood.min_points = kPoints + 1;
  EXPECT_EQ(count(Localizer(config).localize(cloudOf(near)), Outcome::too_few_points), 20U);
}

TEST(Localizer, DoesNotDependOnCloudsSeenBefore)
{
  const Cloud table = captureScene("table", 1).cloud;
  Config config;
  config.sampling.samples = 1000;
  Localizer localizer(config);
  const Localization first = localizer.localize(table);
  localizer.localize(captureScene("table", 2).cloud);
  localizer.localize(cloudOf({{0, 0, 1}}));
  const Localization again = localizer.localize(table);
  ASSERT_EQ(first.counts, again.counts);
  for (std::size_t i = 0; i < first.shells.size(); ++i) {
    EXPECT_TRUE(same(first.shells[i], again.shells[i]));
  }
  config.sampling.seed = 2;
  const Localization other = Localizer(config).localize(table);
  EXPECT_NE(other.counts, first.counts) << "another seed draws other samples";
}

class TableScene : public testing::TestWithParam<std::string>
{
};

TEST_P(TableScene, HasItsThreeAffordancesFoundInEverySeed)
{
  Localizer localizer(presetConfig(GetParam()));
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const LabelledFrame frame = captureScene("table", seed);
    const Localization result = localizer.localize(frame.cloud);
    expectSound(result, "seed " + std::to_string(seed));
    std::set<std::uint32_t> found;
    for (const Shell& shell : result.shells) {
      found.insert(judge(shell, frame.cloud, frame.labels).affordance);
    }
    for (const std::uint32_t label : {1, 2, 3}) {
      EXPECT_EQ(found.count(label), 1U) << "affordance " << label << ", seed " << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Localizer, TableScene, testing::ValuesIn(presetNames()),
                         [](const testing::TestParamInfo<std::string>& info) { return info.param; });

TEST(Localizer, FindsNothingOnAnEmptyTable)
{
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    EXPECT_TRUE(Localizer().localize(captureScene("empty_table", seed).cloud).shells.empty()) << seed;
  }
}

/// A camera 0.6 m from the rim of a mug at the origin, looking down into it at 60 degrees.
Eigen::Isometry3d cameraAboveMug()
{
  const Eigen::Vector3d rim(0.0, 0.0, 0.08);
  const Eigen::Vector3d forward(0.0, std::cos(M_PI / 3), -std::sin(M_PI / 3));
  Eigen::Isometry3d T_scene_camera = Eigen::Isometry3d::Identity();
  T_scene_camera.linear() << Eigen::Vector3d::UnitX(), forward.cross(Eigen::Vector3d::UnitX()), forward;
  T_scene_camera.translation() = rim - 0.6 * forward;
  return T_scene_camera;
}

TEST(Localizer, FindsTheHandleOfAMugButNotItsInside)
{
  const Mug mug;
  View view;
  view.scene.add(Box{{1.0, 1.0, 0.03}}, Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, -0.015)));
  add(view.scene, Eigen::Isometry3d::Identity(), mug);
  view.T_scene_camera = cameraAboveMug();
  const LabelledFrame frame = captureView(view, 1);
  const auto insideTheMug = [&](std::uint32_t index) {
    const Eigen::Vector3d p = cameraAboveMug() * frame.cloud.point(index).cast<double>();
    return p.head<2>().norm() < mug.radius - mug.wall + 0.003 && p.z() > mug.floor + 0.01 && p.z() < mug.height - 0.005;
  };

  Config config;
  config.sampling.samples = 20000;
  const Localization small_hand = Localizer(config).localize(frame.cloud);
  bool handle_found = false;
  for (const Shell& shell : small_hand.shells) {
    handle_found = handle_found || judge(shell, frame.cloud, frame.labels).affordance == 1;
    EXPECT_FALSE(insideTheMug(shell.point_index));
  }
  EXPECT_TRUE(handle_found);

  // To a hand that is large enough for the whole mug its inside looks like a graspable cylinder, but for its sign.
  config.hand.capture_radius = 0.05;
  const auto shellsFromInside = [&](const Localization& result) {
    return std::count_if(result.shells.begin(), result.shells.end(),
                         [&](const Shell& shell) { return insideTheMug(shell.point_index); });
  };
  const Localization large_hand = Localizer(config).localize(frame.cloud);
  EXPECT_EQ(shellsFromInside(large_hand), 0);
  EXPECT_GT(count(large_hand, Outcome::concave), 100U);
  config.estimation.reject_concave = false;
  EXPECT_GT(shellsFromInside(Localizer(config).localize(frame.cloud)), 0) << "the sign is what rejects it";
}

/// The forged bar: a strip of wall between the shadows of two plates.
TEST(PaperPreset, RejectsABackgroundShapeForgedByShadows)
{
  const LabelledFrame shadow = captureStrip("shadow", 1), removed = captureStrip("shadow_removed", 1);
  const auto onTheStrip = [](const Frame& frame, const Localization& result) {
    int shells = 0;
    for (const Shell& shell : result.shells) {
      shells += frame.cloud.z[shell.point_index] > 1.0F ? 1 : 0;
    }
    return shells;
  };
  Config config = presetConfig("paper");
  config.estimation.estimator = Estimator::pca;  // has no curvature test that would reject the flat strip
  const Localization with_plates = Localizer(config).localize(shadow.cloud);
  EXPECT_EQ(onTheStrip(shadow, with_plates), 0);
  EXPECT_GT(count(with_plates, Outcome::occluded), 0U);
  const Localization without_plates = Localizer(config).localize(removed.cloud);
  EXPECT_LT(count(without_plates, Outcome::occluded), without_plates.sampled / 100)
      << "the same background points without the foreground are kept, but for their own noise";
  EXPECT_GT(onTheStrip(removed, without_plates), 0);
  config.occlusion.filter = false;
  EXPECT_GT(onTheStrip(shadow, Localizer(config).localize(shadow.cloud)), 0) << "the filter is what rejects them";
}

TEST(Localizer, ExplainsACloudWithNothingToLocalize)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  Localizer localizer;
  Cloud empty;
  Cloud bad;
  bad.reset(64, 48);
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const std::size_t kind = i % 4;
    bad.set(i, kind == 0 ? nan : kind == 1 ? infinity : 0.0F, kind == 2 ? 1e30F : 0.0F, kind == 0 ? nan : 0.0F);
  }
  Cloud half;  // x and y finite where z is NaN
  half.reset(64, 48);
  for (std::size_t i = 0; i < half.size(); ++i) {
    half.set(i, 0.1F, 0.2F, nan);
  }
  Cloud same;
  same.reset(64, 48);
  for (std::size_t i = 0; i < same.size(); ++i) {
    same.set(i, 0.1F, 0.2F, 1.0F);
  }
  for (const Cloud* cloud : {&empty, &bad, &half, &same}) {
    const Localization result = localizer.localize(*cloud);
    EXPECT_EQ(result.sampled, 0U);
    EXPECT_TRUE(result.shells.empty());
    ASSERT_EQ(result.warnings.size(), 1U);
    EXPECT_EQ(result.warnings[0].find("nothing to localize"), 0U) << result.warnings[0];
  }
}

TEST(Localizer, WorksOnCloudsWithoutARangeImage)
{
  const LabelledFrame frame = captureScene("table", 1);
  Config config;
  config.sampling.samples = 2000;

  Cloud moved = frame.cloud;  // as by a transformation into the frame of a robot's base
  const Eigen::Isometry3f T =
      Eigen::Translation3f(0.3F, -0.2F, 1.0F) * Eigen::AngleAxisf(2.0F, Eigen::Vector3f::UnitX());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Eigen::Vector3f p = T * frame.cloud.point(i);
    moved.set(i, p.x(), p.y(), p.z());
  }
  moved.sensor_origin = Eigen::Vector3f(T.translation());

  Cloud behind = frame.cloud;  // x right, y up, z backward
  for (std::size_t i = 0; i < behind.size(); ++i) {
    behind.set(i, frame.cloud.x[i], -frame.cloud.y[i], -frame.cloud.z[i]);
  }
  behind.sensor_origin = Eigen::Vector3f::Zero();

  Cloud without_rows = unorganized(frame.cloud);
  for (const Cloud* cloud : {&without_rows, &moved, &behind}) {
    const Localization result = Localizer(config).localize(*cloud);
    expectSound(result, "without a range image");
    ASSERT_EQ(result.warnings.size(), 1U);
    EXPECT_NE(result.warnings[0].find("occlusion and observed free space are not judged"), std::string::npos);
    EXPECT_EQ(count(result, Outcome::occluded), 0U);
    std::set<std::uint32_t> found;
    for (const Shell& shell : result.shells) {
      EXPECT_TRUE(std::isnan(shell.observed_free));
      EXPECT_GE(shell.normal.dot(cloud->sensor_origin->cast<double>() - shell.centroid), 0.0);
      found.insert(judge(shell, *cloud, frame.labels).affordance);
    }
    EXPECT_EQ(found.count(3), 1U) << "the bar";
  }
}

TEST(Transformed, TurnsAShellAndKeepsItsAxisAlongTheLargestComponent)
{
  Shell shell;
  shell.centroid = {0.1, -0.2, 0.7};
  shell.axis = Eigen::Vector3d(0.2, 0.9, 0.3).normalized();
  shell.normal = shell.axis.unitOrthogonal();
  shell.length = 0.045;
  const Eigen::Isometry3d T(Eigen::Translation3d(1.0, 2.0, 3.0) *
                            Eigen::AngleAxisd(3.0, Eigen::Vector3d::UnitX()));  // turns y and z over
  const Shell moved = transformed(shell, T);
  EXPECT_TRUE(moved.centroid.isApprox(T * shell.centroid, 1e-12));
  EXPECT_TRUE(moved.axis.isApprox(-(T.linear() * shell.axis), 1e-12));
  EXPECT_GT(moved.axis.y(), 0.8);
  EXPECT_TRUE(moved.normal.isApprox(T.linear() * shell.normal, 1e-12));
  EXPECT_EQ(moved.length, shell.length);
}

TEST(Localizer, TellsWhereEachSampleEnded)
{
  Localizer localizer;
  EXPECT_TRUE(localizer.sampleEnds().empty());
  const Localization result = localizer.localize(captureScene("table", 1).cloud);
  std::array<std::uint32_t, kOutcomes> counts{};
  std::vector<std::uint32_t> shells;
  for (const SampleEnd& sample : localizer.sampleEnds()) {
    ++counts[static_cast<std::size_t>(sample.outcome)];
    if (sample.outcome == Outcome::shell) {
      shells.push_back(sample.point_index);
    }
  }
  EXPECT_EQ(counts, result.counts);
  ASSERT_EQ(shells.size(), result.shells.size());
  for (std::size_t i = 0; i < shells.size(); ++i) {
    EXPECT_EQ(shells[i], result.shells[i].point_index);
  }
  localizer.localize(Cloud());
  EXPECT_TRUE(localizer.sampleEnds().empty()) << "of a cloud without samples";
}

TEST(Localizer, RefusesParametersOutsideTheirRange)
{
  Config config;
  config.hand.capture_radius = -1.0;
  EXPECT_THROW(Localizer{config}, ParameterError);  // cppcheck-suppress unusedScopedObject; it throws
}

}  // namespace
}  // namespace grasp_affordances::test
