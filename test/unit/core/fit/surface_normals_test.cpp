#include "core/fit/surface_normals.h"

#include "support/points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

constexpr float kRadius = 0.03F;  // m
constexpr std::size_t kWidth = 24, kHeight = 18;

/// A bent sheet, seen as an image, with holes.
Cloud sheet()
{
  Cloud cloud;
  cloud.reset(kWidth, kHeight);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (i % 11 != 3) {
      const std::size_t column = i % kWidth, row = i / kWidth;
      const float x = 0.005F * static_cast<float>(column), y = 0.005F * static_cast<float>(row);
      cloud.set(i, x, y, 1.0F + 4.0F * x * x + 0.5F * y);
    }
  }
  return cloud;
}

bool hasNormal(const SurfaceNormals& surface, std::size_t i)
{
  return !std::isnan(surface.normals().x[i]);
}

void require(const Neighborhood& neighborhood, SurfaceNormals& surface)
{
  surface.require(neighborhood.index(), neighborhood.size());
}

TEST(SurfaceNormals, AreThoseOfThePointsAskedFor)
{
  const Cloud cloud = sheet();
  const auto search = makeTreeSearch(cloud);
  const Neighborhood asked = bruteForceNeighborhood(cloud, cloud.point(200), 0.02F);
  for (const int threads : {1, 3}) {
    ThreadTeam team(threads);
    SurfaceNormals surface;
    for (int round = 0; round < 2; ++round) {  // nothing stays from a cloud before
      surface.reset(cloud.size());
      if (round == 0) {
        require(bruteForceNeighborhood(cloud, cloud.point(0), 0.02F), surface);
      } else {
        require(asked, surface);
      }
      surface.compute(cloud, *search, kRadius, 1, team);
    }
    std::vector<bool> required(cloud.size());
    for (std::size_t i = 0; i < asked.size(); ++i) {
      required[asked.index()[i]] = true;
      const auto normal = planeNormal(bruteForceNeighborhood(cloud, asked.point(i), kRadius));
      ASSERT_TRUE(normal);
      EXPECT_EQ(surface.normals().normal(asked.index()[i]), normal->cast<float>());
    }
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      EXPECT_EQ(hasNormal(surface, i), required[i]) << i;
    }
  }
}

/// Which points of the sheet get a normal with a stride of 4, when all are asked for.
std::vector<bool> sparseNormals(const Cloud& cloud)
{
  ThreadTeam team(1);
  SurfaceNormals surface;
  surface.reset(cloud.size());
  require(bruteForceNeighborhood(cloud, cloud.point(0), 10.0F), surface);
  surface.compute(cloud, *makeTreeSearch(cloud), kRadius, SurfaceNormals::kSparseStride, team);
  std::vector<bool> has;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    has.push_back(hasNormal(surface, i));
  }
  return has;
}

TEST(SurfaceNormals, AreSparseInRowsAndColumns)
{
  const Cloud cloud = sheet();
  const auto of_image = sparseNormals(cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool on_grid = i % kWidth % 4 == 0 && i / kWidth % 4 == 0;
    EXPECT_EQ(of_image[i], on_grid && cloud.measured(i)) << i;
  }
  const auto of_list = sparseNormals(unorganized(cloud));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_EQ(of_list[i], i % 16 == 0 && cloud.measured(i)) << i;
  }
}

}  // namespace
}  // namespace grasp_affordances::test
