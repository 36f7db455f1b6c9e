#include "core/result/polyline.h"

#include "support/points.h"
#include "support/polylines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace grasp_affordances::test
{
namespace
{

const double kDegree = M_PI / 180.0;

TEST(Polyline, PlacesAlongItAreCountedFromItsBeginning)
{
  const Polyline line{{0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {3.0, 4.0, 0.0}};
  EXPECT_EQ(lengthOf(line), 7.0);
  EXPECT_EQ(pointAt(line, 0.0), line.front());
  EXPECT_EQ(pointAt(line, 1.5), Eigen::Vector3d(1.5, 0.0, 0.0));
  EXPECT_EQ(pointAt(line, 3.0), line[1]);
  EXPECT_EQ(pointAt(line, 5.0), Eigen::Vector3d(3.0, 2.0, 0.0));
  EXPECT_EQ(pointAt(line, 7.0), line.back());
  const PolylineDistance bent = placeAtDistance(line, 5.0);
  EXPECT_EQ(bent.segment, 2U) << "the segment without a length is passed over";
  EXPECT_EQ(bent.from_start, 2.0);
  EXPECT_EQ(bent.segment_length, 4.0);
}

TEST(Polyline, PlacesBeyondTheEndsAreTheEnds)
{
  const Polyline line{{0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {3.0, 4.0, 0.0}};
  EXPECT_EQ(pointAt(line, -1.0), line.front());
  EXPECT_EQ(pointAt(line, 7.5), line.back());
  const PolylineDistance beyond = placeAtDistance(line, 7.5);
  EXPECT_EQ(beyond.segment, 1U);
  EXPECT_EQ(beyond.from_start, 4.5);
  const Polyline point{{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}};
  EXPECT_EQ(pointAt(point, 0.0), point.front());
}

TEST(Polyline, MiddleIsHalfTheLengthFromBothEnds)
{
  const Polyline line{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.0, 4.0}};
  const PolylineMiddle middle = middleOf(line);
  EXPECT_EQ(middle.point, Eigen::Vector3d(1.0, 0.0, 1.5));
  EXPECT_EQ(middle.direction, Eigen::Vector3d::UnitZ());
  const PolylineMiddle back = middleOf({line.rbegin(), line.rend()});
  EXPECT_EQ(back.point, middle.point);
  EXPECT_EQ(back.direction, -middle.direction);
  const Eigen::Vector3d place(1.0, 2.0, 3.0);
  EXPECT_EQ(middleOf({place, place}).point, place) << "without a length";
  EXPECT_EQ(middleOf({place, place}).direction, Eigen::Vector3d::UnitZ());
}

TEST(Polyline, ChordAroundAPointLeadsFromItsOneNeighborToTheOther)
{
  const Polyline line{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 2.0, 0.0}};
  EXPECT_EQ(chordAround(line, 0), Eigen::Vector3d(1.0, 0.0, 0.0));
  EXPECT_EQ(chordAround(line, 1), Eigen::Vector3d(1.0, 2.0, 0.0));
  EXPECT_EQ(chordAround(line, 2), Eigen::Vector3d(0.0, 2.0, 0.0));
}

TEST(Polyline, NearestPlaceIsThatOfAllPlacesTriedOneByOne)
{
  Random random(1);
  const Polyline line{{0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}, {0.1, 0.05, 0.02}, {0.0, 0.1, 0.1}};
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d point(random.uniform(-0.1, 0.2), random.uniform(-0.1, 0.2), random.uniform(-0.1, 0.2));
    double least = std::numeric_limits<double>::infinity();
    constexpr int kSteps = 1000;
    for (std::size_t segment = 0; segment + 1 < line.size(); ++segment) {
      for (int step = 0; step <= kSteps; ++step) {
        const Eigen::Vector3d place = line[segment] + (line[segment + 1] - line[segment]) * step / kSteps;
        least = std::min(least, (point - place).norm());
      }
    }
    const PolylinePlace place = nearestPlace(line, point);
    ASSERT_NEAR(place.offset.norm(), least, 1e-4) << i;
    ASSERT_LE(place.offset.norm(), least + 1e-12) << i;
    const Eigen::Vector3d there =
        line[place.segment] + place.share * (line[place.segment + 1] - line[place.segment]) + place.offset;
    ASSERT_TRUE(there.isApprox(point, 1e-9)) << i;
  }
}

TEST(Polyline, TangentIsThatOfTheCircleThatItFollows)
{
  constexpr int kSegments = 24;  // of 7.5 degrees
  const Polyline line = halfCircle(0.03, kSegments);
  for (double angle = 10.0; angle <= 170.0; angle += 1.0) {
    const Eigen::Vector3d outwards(std::cos(angle * kDegree), std::sin(angle * kDegree), 0.0);
    const Eigen::Vector3d tangent(-outwards.y(), outwards.x(), 0.0);
    const Eigen::Vector3d found = tangentAt(line, nearestPlace(line, 0.03 * outwards));
    EXPECT_LT(std::acos(std::min(1.0, found.dot(tangent))), 0.05 * kDegree) << "at " << angle << " degrees";
  }
}

TEST(Polyline, DistanceAcrossLeavesOutWhatIsBeyondAnEnd)
{
  const Polyline line{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.1}};
  const auto across = [&](const Eigen::Vector3d& point) { return distanceAcross(line, nearestPlace(line, point)); };
  EXPECT_DOUBLE_EQ(across({0.003, 0.004, 0.05}), 0.005);
  EXPECT_DOUBLE_EQ(across({0.003, 0.004, 0.15}), 0.005);
  EXPECT_DOUBLE_EQ(across({0.003, 0.004, -0.07}), 0.005);
}

TEST(Polyline, DistanceBesideKnowsNothingOfPointsBeyondTheEnds)
{
  const Polyline line{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.1}};
  EXPECT_NEAR(distanceBeside(line, {0.003, 0.004, 0.05}), 0.005, 1e-12);
  EXPECT_NEAR(distanceBeside(line, {0.003, 0.004, 0.1}), 0.005, 1e-12);
  EXPECT_EQ(distanceBeside(line, {0.003, 0.004, 0.11}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(distanceBeside(line, {0.003, 0.004, -0.01}), std::numeric_limits<double>::infinity());
  // Outside a bend the corner is nearest. Beyond an end another segment counts, though it is farther than the end.
  const Polyline bent{{0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}, {0.1, 0.1, 0.0}};
  EXPECT_NEAR(distanceBeside(bent, {0.103, -0.004, 0.0}), 0.005, 1e-12);
  EXPECT_NEAR(distanceBeside(bent, {-0.01, 0.05, 0.0}), 0.11, 1e-12);
  EXPECT_LT(nearestPlace(bent, {-0.01, 0.05, 0.0}).offset.norm(), 0.06);
}

}  // namespace
}  // namespace grasp_affordances::test
