#include "grasp_affordances/localizer.h"

#include "support/instruction_sets.h"
#include "support/points.h"
#include "support/scenes.h"
#include "support/shells.h"
#include "support/table.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

void expectSame(const Localization& a, const Localization& b, const std::string& what)
{
  EXPECT_EQ(a.counts, b.counts) << what;
  EXPECT_EQ(a.sampled, b.sampled) << what;
  ASSERT_EQ(a.shells.size(), b.shells.size()) << what;
  for (std::size_t i = 0; i < a.shells.size(); ++i) {
    ASSERT_TRUE(same(a.shells[i], b.shells[i])) << what << ", shell " << i;
  }
  ASSERT_EQ(a.handles.size(), b.handles.size()) << what;
  for (std::size_t i = 0; i < a.handles.size(); ++i) {
    EXPECT_EQ(a.handles[i].shells, b.handles[i].shells) << what;
    EXPECT_EQ(a.handles[i].polyline, b.handles[i].polyline) << what;
    EXPECT_EQ(a.handles[i].score, b.handles[i].score) << what;
  }
}

struct Variation
{
  std::string name;
  Estimator estimator;
  NormalsMode mode;
};

class EveryEstimator : public testing::TestWithParam<Variation>
{
protected:
  Config config() const
  {
    Config config;
    config.estimation.estimator = GetParam().estimator;
    config.estimation.normals_mode = GetParam().mode;
    config.sampling.samples = 600;
    return config;
  }
};

TEST_P(EveryEstimator, FindsTheSameWithAnyNumberOfThreadsAndInstructionSet)
{
  Config config = this->config();
  config.threads = 1;
  Localizer reference_localizer(config);
  const Localization of_image = reference_localizer.localize(table());
  Localization of_views;
  reference_localizer.localize(tableFromTwoSides().posed(), of_views);
  EXPECT_GT(of_image.shells.size(), 10U);
  for (const int threads : {1, 2, 4}) {
    config.threads = threads;
    Localizer localizer(config);
    expectSame(localizer.localize(table()), of_image, std::to_string(threads) + " threads");
    Localization result;
    localizer.localize(tableFromTwoSides().posed(), result);
    expectSame(result, of_views, "two views, " + std::to_string(threads) + " threads");
  }
  Localizer localizer(config);
  for (const std::string& name : instructionSets()) {
    useInstructionSet(name);
    expectSame(localizer.localize(table()), of_image, name);
  }
  useInstructionSet("");
}

TEST_P(EveryEstimator, DoesNotDependOnCloudsLocalizedBefore)
{
  const Cloud other = captureScene("cleaning2", 1).cloud;
  const Config config = this->config();
  const Localization fresh = Localizer(config).localize(table());
  Localizer localizer(config);
  localizer.localize(other);
  expectSame(localizer.localize(table()), fresh, "after another cloud");
  Localization result;
  localizer.localize(tableFromTwoSides().posed(), result);
  expectSame(localizer.localize(table()), fresh, "after two views");
  localizer.localize(Cloud());
  localizer.localize(cloudOf({{0, 0, 1}, {0, 0.01, 1}}));
  localizer.localize(table(), result);
  expectSame(result, fresh, "after clouds of nothing, into a used result");
  EXPECT_EQ(result.warnings, fresh.warnings);
}

TEST_P(EveryEstimator, GoesOnWithOtherParametersAsANewOneWould)
{
  Config config = this->config(), other = config;
  other.sampling.samples = 900;
  other.sampling.importance = false;
  other.sampling.seed = 3;
  other.threads = config.threads == 2 ? 1 : 2;
  other.handles.min_support = 5;
  other.shell.continue_surfaces = false;
  Localizer localizer(config);
  const Localization before = localizer.localize(table());
  localizer.configure(other);
  EXPECT_EQ(localizer.config().sampling.samples, 900);
  expectSame(localizer.localize(table()), Localizer(other).localize(table()), "reconfigured");
  localizer.configure(config);
  expectSame(localizer.localize(table()), before, "configured back");
  Config wrong = other;
  wrong.hand.capture_radius = -1.0;
  EXPECT_THROW(localizer.configure(wrong), ParameterError);
  expectSame(localizer.localize(table()), before, "after a refusal");
}

INSTANTIATE_TEST_SUITE_P(Localizer, EveryEstimator,
                         testing::Values(Variation{"taubin", Estimator::taubin, NormalsMode::exact},
                                         Variation{"pca", Estimator::pca, NormalsMode::exact},
                                         Variation{"normals", Estimator::normals, NormalsMode::exact},
                                         Variation{"sparse_normals", Estimator::normals, NormalsMode::sparse}),
                         [](const testing::TestParamInfo<Variation>& info) { return info.param.name; });

}  // namespace
}  // namespace grasp_affordances::test
