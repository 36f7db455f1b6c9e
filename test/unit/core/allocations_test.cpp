#include "grasp_affordances/localizer.h"
#include "grasp_affordances/parameters.h"

#include "core/hand_poses/hand_pose_search.h"
#include "core/parallel/thread_team.h"
#include "core/views/prepared_views.h"
#include "core/views/view_comparison.h"
#include "simulation/camera_orbit.h"
#include "support/sanitizers.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <string>
#include <vector>

namespace
{

std::atomic<std::size_t> allocations{0};  // of all threads, since the start of the process

}  // namespace

#if !GRASP_AFFORDANCES_SANITIZER
// Watches everything that asks for memory: operator new, Eigen and TBB, too, end up here.
extern "C" {
// NOLINTBEGIN(readability-identifier-naming): glibc's names
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
// NOLINTEND(readability-identifier-naming)

void* malloc(std::size_t size)
{
  ++allocations;
  return __libc_malloc(size);
}

void* calloc(std::size_t nmemb, std::size_t size)
{
  ++allocations;
  return __libc_calloc(nmemb, size);
}

void* realloc(void* ptr, std::size_t size)
{
  ++allocations;
  return __libc_realloc(ptr, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size)
{
  ++allocations;
  return __libc_memalign(alignment, size);
}
}
#endif

namespace grasp_affordances::test
{
namespace
{

struct Variation
{
  const char* preset;
  Estimator estimator;
  NeighborhoodKind kind;
};

class Allocations : public testing::TestWithParam<Variation>
{
};

INSTANTIATE_TEST_SUITE_P(Localizer, Allocations,
                         testing::Values(Variation{"localizer", Estimator::taubin, NeighborhoodKind::radius},
                                         Variation{"paper", Estimator::taubin, NeighborhoodKind::radius},
                                         Variation{"paper", Estimator::taubin, NeighborhoodKind::knn},
                                         Variation{"paper", Estimator::pca, NeighborhoodKind::radius},
                                         Variation{"localizer", Estimator::normals, NeighborhoodKind::radius}),
                         [](const auto& info) {
                           return std::string(info.param.preset) + "_" + enumWord(info.param.estimator) + "_" +
                                  enumWord(info.param.kind);
                         });

TEST(AllocationCounter, Counts)
{
  if (GRASP_AFFORDANCES_SANITIZER) {
    GTEST_SKIP() << "SKIPPED: a sanitizer allocates";
  }
  const std::size_t before = allocations;
  const std::vector<int> numbers(1000, 1);
  const Eigen::VectorXd vector = Eigen::VectorXd::Ones(1000);
  EXPECT_GE(allocations - before, 2U) << numbers.front() << vector[0];
}

TEST_P(Allocations, NoneIsMadeForAFrameOnceMemoryHasGrown)
{
  if (GRASP_AFFORDANCES_SANITIZER) {
    GTEST_SKIP() << "SKIPPED: a sanitizer allocates";
  }
  Config config = presetConfig(GetParam().preset);
  config.estimation.estimator = GetParam().estimator;
  config.neighborhood.kind = GetParam().kind;
  config.sampling.samples = 1000;
  // The camera moves a little: other clouds, of the same scene.
  std::vector<Cloud> clouds;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    clouds.push_back(captureView(makeScene("table", 1), seed).cloud);
  }
  for (const int threads : {1, 2}) {
    config.threads = threads;
    Localizer localizer(config);
    Localization result;
    // Which thread gets which sample, and with it which thread's memory has to grow, differs from frame to frame.
    constexpr int kQuietFrames = 6, kMostFrames = 200;
    int frames = 0, quiet = 0;
    for (; frames < kMostFrames && quiet < kQuietFrames; ++frames) {
      const std::size_t before = allocations;
      localizer.localize(clouds[static_cast<std::size_t>(frames) % clouds.size()], result);
      quiet = allocations == before ? quiet + 1 : 0;
    }
    EXPECT_EQ(quiet, kQuietFrames) << threads << " threads, " << frames << " frames";
    EXPECT_GT(result.shells.size(), 0U);
  }
}

TEST(ViewAgreementAllocations, NoneForViewsSeenBefore)
{
  if (GRASP_AFFORDANCES_SANITIZER) {
    GTEST_SKIP() << "SKIPPED: a sanitizer allocates";
  }
  const View view = makeScene("table", 1), turned = viewFromAside(view, 0.5);
  const Cloud first = captureView(view, 1).cloud, second = captureView(turned, 2).cloud;
  std::string warning;
  const auto first_image = RangeImage::create(first, warning), second_image = RangeImage::create(second, warning);
  const Eigen::Isometry3d T_first_second = view.T_scene_camera.inverse() * turned.T_scene_camera;
  ViewAgreement agreement;
  const double expected = agreement.disagreement(*first_image, *second_image, T_first_second);
  const std::size_t before = allocations;
  const double again = agreement.disagreement(*first_image, *second_image, T_first_second);
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(again, expected);
}

TEST(HandPoseAllocations, NoneForAHandleSeenBefore)
{
  if (GRASP_AFFORDANCES_SANITIZER) {
    GTEST_SKIP() << "SKIPPED: a sanitizer allocates";
  }
  const Cloud cloud = captureView(makeScene("table", 1), 1).cloud;
  const Config config;
  std::vector<GraspHandle> handles = Localizer(config).localize(cloud).handles;
  ASSERT_GT(handles.size(), 0U);
  const Eigen::Isometry3d identity = Eigen::Isometry3d::Identity();
  ThreadTeam team(1);
  PreparedViews views;
  views.update({{&cloud, identity}}, config, identity, team);
  HandPoseSearch search;
  std::size_t poses = 0, before = 0;
  for (int round = 0; round < 2; ++round) {
    before = allocations;
    for (GraspHandle& handle : handles) {
      search.search(views, config, identity, handle);
      poses += handle.hand_poses.size();
    }
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(poses, 0U);
}

}  // namespace
}  // namespace grasp_affordances::test
