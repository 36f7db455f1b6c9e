#include "core/fit/curvature.h"
#include "core/fit/full_quadric_fit.h"
#include "core/kernels/instruction_sets.h"
#include "core/kernels/moment_sums.h"
#include "core/kernels/quadric_curvatures.h"
#include "core/kernels/quadric_fits.h"
#include "core/kernels/window_scan.h"
#include "support/points.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Every kernel with every instruction set that this processor has.
class Kernel : public testing::TestWithParam<std::string>
{
protected:
  void SetUp() override { useInstructionSet(GetParam()); }
  void TearDown() override { useInstructionSet(""); }
};

INSTANTIATE_TEST_SUITE_P(InstructionSets, Kernel, testing::ValuesIn(instructionSets()),
                         [](const auto& info) { return info.param; });

TEST(InstructionSets, UnknownNamesAreRefused)
{
  EXPECT_FALSE(instructionSets().empty());
  EXPECT_THROW(useInstructionSet("abacus"), std::invalid_argument);
}

/// An image of a wavy surface, every seventh pixel of which is not measured.
class WavyImage
{
public:
  static constexpr std::size_t kWidth = 61, kHeight = 23, kPoints = kWidth * kHeight;

  WavyImage() : cloud(Cloud())
  {
    Random random(3);
    cloud.reset(kWidth, kHeight);
    for (std::size_t i = 0; i < kPoints; ++i) {
      const std::size_t column = i % kWidth, row = i / kWidth;
      const auto u = static_cast<double>(column), v = static_cast<double>(row);
      const double z = 0.8 + 0.01 * std::sin(0.3 * u) + random.uniform(0.0, 0.004);
      if (i % 7 != 3) {
        cloud.set(i, static_cast<float>((u - 30.0) / 575.0 * z), static_cast<float>((v - 11.0) / 575.0 * z),
                  static_cast<float>(z));
      }
    }
  }

  PixelRows window(std::size_t u, std::size_t v, std::size_t columns, std::size_t rows) const
  {
    return {cloud.x.data(), cloud.y.data(), cloud.z.data(), kPoints, v * kWidth + u, rows, columns, kWidth};
  }

  Cloud cloud;
};

std::vector<std::size_t> pixels(const PixelRows& window)
{
  std::vector<std::size_t> pixels;
  for (std::size_t row = 0; row < window.rows; ++row) {
    for (std::size_t column = 0; column < window.columns; ++column) {
      pixels.push_back(window.first + row * window.stride + column);
    }
  }
  return pixels;
}

TEST_P(Kernel, GathersTheSphereAndNothingElse)
{
  const WavyImage image;
  const float center[3] = {0.001F, -0.002F, 0.805F};
  for (const std::size_t columns : {0, 1, 3, 4, 7, 8, 9, 15, 16, 17, 31, 33, 61}) {
    for (const float radius : {0.0F, 0.004F, 0.011F, kInfinity}) {
      // The window ends with the image: nothing may be read beyond it.
      const PixelRows window = image.window(WavyImage::kWidth - columns, 2, columns, WavyImage::kHeight - 2);
      std::vector<std::uint32_t> expected;
      float closest = kInfinity, closest_in_window = kInfinity;
      for (const std::size_t i : pixels(window)) {
        const Eigen::Vector3f p = image.cloud.point(i);
        const float range = squaredLength(p.x(), p.y(), p.z());
        closest_in_window = std::min(closest_in_window, image.cloud.measured(i) ? range : kInfinity);
        if (squaredLength(p.x() - center[0], p.y() - center[1], p.z() - center[2]) <= radius * radius) {
          expected.push_back(static_cast<std::uint32_t>(i));
          closest = std::min(closest, range);
        }
      }
      const std::size_t room = window.rows * window.columns + kGatherSlack;
      std::vector<float> x(room), y(room), z(room);
      std::vector<std::uint32_t> index(room);
      const SphereSurvey gathered =
          gatherSphere(window, center, radius * radius, {x.data(), y.data(), z.data(), index.data()});
      const SphereSurvey survey = surveySphere(window, center, radius * radius);
      const std::size_t count = gathered.points;
      EXPECT_EQ(survey.points, count);
      EXPECT_EQ(gathered.closest, closest) << columns << " columns, radius " << radius;
      EXPECT_EQ(survey.closest, closest) << columns << " columns, radius " << radius;
      EXPECT_EQ(gathered.closest_in_window, closest_in_window) << columns << " columns, radius " << radius;
      index.resize(count);
      ASSERT_EQ(index, expected) << columns << " columns, radius " << radius;
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_EQ(Eigen::Vector3f(x[i], y[i], z[i]), image.cloud.point(index[i]));
      }

      std::vector<float> x_again(room), y_again(room), z_again(room);
      std::vector<std::uint32_t> index_again(room);
      ASSERT_EQ(gatherUnsurveyed(window, center, radius * radius,
                                 {x_again.data(), y_again.data(), z_again.data(), index_again.data()}),
                count);
      index_again.resize(count);
      ASSERT_EQ(index_again, expected) << columns << " columns, radius " << radius;
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_EQ(Eigen::Vector3f(x_again[i], y_again[i], z_again[i]), Eigen::Vector3f(x[i], y[i], z[i]));
      }
    }
  }
}

TEST_P(Kernel, FindsTheClosestRange)
{
  Random random(4);
  std::vector<float> x, y, z;
  EXPECT_EQ(closestSquaredRange(x.data(), y.data(), z.data(), 0), kInfinity);
  float expected = kInfinity;
  for (int count = 1; count < 70; ++count) {
    x.push_back(static_cast<float>(random.uniform(-1.0, 1.0)));
    y.push_back(static_cast<float>(random.uniform(-1.0, 1.0)));
    z.push_back(static_cast<float>(random.uniform(2.0 - 0.02 * count, 2.0)));
    expected = std::min(expected, squaredLength(x.back(), y.back(), z.back()));
    EXPECT_EQ(closestSquaredRange(x.data(), y.data(), z.data(), x.size()), expected) << count;
  }
}

TEST_P(Kernel, CountsWhatIsNearerInTheCone)
{
  const WavyImage image;
  const Eigen::Vector3f center(0.001F, -0.002F, 0.83F);
  for (const float radius : {0.005F, 0.012F, 2.0F}) {  // the last one: the sensor is inside
    for (const float range : {0.79F, 0.805F, 1.0F}) {
      for (const std::size_t columns : {5, 16, 37, 61}) {
        const PixelRows window = image.window(WavyImage::kWidth - columns, 0, columns, WavyImage::kHeight);
        const float tangent = center.squaredNorm() - radius * radius;
        std::size_t expected = 0;
        for (const std::size_t i : pixels(window)) {
          const Eigen::Vector3f p = image.cloud.point(i);
          const float squared = squaredLength(p.x(), p.y(), p.z());
          const float along = p.x() * center.x() + p.y() * center.y() + p.z() * center.z();
          const bool in_cone = tangent <= 0.0F || (along >= 0.0F && along * along >= tangent * squared);
          expected += image.cloud.measured(i) && squared < range * range && in_cone ? 1 : 0;
        }
        const ViewCone cone{{center.x(), center.y(), center.z()}, tangent};
        EXPECT_EQ(countNearer(window, cone, range * range, WavyImage::kPoints), expected)
            << "radius " << radius << " range " << range << " columns " << columns;
        const std::size_t enough = expected / 2;
        const std::size_t stopped = countNearer(window, cone, range * range, enough);
        EXPECT_LE(stopped, expected);
        EXPECT_EQ(stopped > enough, expected > enough);
      }
    }
  }
}

TEST_P(Kernel, SumsMomentsInEightParts)
{
  Random random(5);
  std::vector<float> x, y, z;
  const double center[3] = {0.1, -0.2, 0.9};
  for (std::size_t count = 0; count < 150; ++count) {
    const float* const coordinates[3] = {x.data(), y.data(), z.data()};
    std::array<double, kMomentCount> sums;
    sumMoments(coordinates, count, center, sums.data());
    EXPECT_EQ(sums[0], static_cast<double>(count));
    for (int i = 0; i <= 4; ++i) {
      for (int j = 0; i + j <= 4; ++j) {
        for (int k = i + j == 0 ? 1 : 0; i + j + k <= 4; ++k) {
          double expected = 0.0, magnitude = 0.0;
          for (std::size_t p = 0; p < count; ++p) {
            const double term =
                std::pow(x[p] - center[0], i) * std::pow(y[p] - center[1], j) * std::pow(z[p] - center[2], k);
            expected += term;
            magnitude += std::abs(term);
          }
          const double rounding = (5.0 + static_cast<double>(count)) * std::numeric_limits<double>::epsilon();
          EXPECT_NEAR(sums[momentIndex(i, j, k)], expected, rounding * magnitude) << i << j << k << " of " << count;
        }
      }
    }
    x.push_back(static_cast<float>(random.uniform(0.0, 0.2)));
    y.push_back(static_cast<float>(random.uniform(-0.3, -0.1)));
    z.push_back(static_cast<float>(random.uniform(0.8, 1.0)));
  }
}

/// Moments of points on a bent sheet with some noise, one kind after another.
QuadricFits someFits(std::size_t seed)
{
  Random random(seed);
  QuadricFits fits{};
  for (std::size_t lane = 0; lane < kFitsAtOnce; ++lane) {
    std::vector<float> x, y, z;
    for (int i = 0; i < 300; ++i) {
      const double u = random.uniform(-0.7, 0.7), v = random.uniform(-0.7, 0.7);
      x.push_back(static_cast<float>(u));
      y.push_back(static_cast<float>(v));
      z.push_back(static_cast<float>(0.1 * static_cast<double>(lane) * u * u + random.uniform(-0.05, 0.05)));
    }
    const float* const coordinates[3] = {x.data(), y.data(), z.data()};
    const double center[3] = {0.0, 0.0, 0.0};
    std::array<double, kMomentCount> sums;
    sumMoments(coordinates, x.size(), center, sums.data());
    for (int m = 0; m < kMomentCount; ++m) {
      fits.moments[m][lane] = sums[m];
    }
  }
  return fits;
}

TEST_P(Kernel, FitsTheSameQuadricsAsEveryOther)
{
  for (std::size_t seed = 1; seed <= 20; ++seed) {
    QuadricFits fits = someFits(seed), reference = fits;
    fitQuadrics(fits, kFitsAtOnce);
    useInstructionSet(instructionSets().back());
    fitQuadrics(reference, kFitsAtOnce);
    useInstructionSet(GetParam());
    EXPECT_EQ(fits.coefficients, reference.coefficients) << "seed " << seed;
    EXPECT_EQ(fits.eigenvalue, reference.eigenvalue) << "seed " << seed;
    EXPECT_EQ(fits.status, reference.status) << "seed " << seed;
  }
}

TEST_P(Kernel, FitsEachQuadricInALaneOfItsOwn)
{
  QuadricFits fits = someFits(30);
  fitQuadrics(fits, kFitsAtOnce);
  for (std::size_t lane = 0; lane < kFitsAtOnce; ++lane) {
    QuadricFits alone{};
    for (int m = 0; m < kMomentCount; ++m) {
      alone.moments[m][0] = fits.moments[m][lane];
    }
    fitQuadrics(alone, 1);
    ASSERT_EQ(fits.status[lane], FitStatus::unique);
    EXPECT_EQ(alone.status[0], FitStatus::unique);
    EXPECT_EQ(alone.eigenvalue[0], fits.eigenvalue[lane]);
    for (std::size_t a = 0; a < fits.coefficients.size(); ++a) {
      EXPECT_EQ(alone.coefficients[a][0], fits.coefficients[a][lane]);
    }
  }
}

/// As someFits, but no points at all in lane 2, and a plane in lane 5.
QuadricFits fitsOfWhichTwoAreNotUnique()
{
  QuadricFits fits = someFits(31);
  for (int m = 0; m < kMomentCount; ++m) {
    fits.moments[m][2] = 0.0;
  }
  for (int i = 0; i <= 4; ++i) {  // z = 0
    for (int j = 0; i + j <= 4; ++j) {
      for (int k = 1; i + j + k <= 4; ++k) {
        fits.moments[momentIndex(i, j, k)][5] = 0.0;
      }
    }
  }
  return fits;
}

TEST_P(Kernel, TellsPlanesFromUniqueQuadrics)
{
  QuadricFits fits = fitsOfWhichTwoAreNotUnique();
  fitQuadrics(fits, kFitsAtOnce);
  for (std::size_t lane = 0; lane < kFitsAtOnce; ++lane) {
    EXPECT_EQ(fits.status[lane], lane == 2 || lane == 5 ? FitStatus::not_unique : FitStatus::unique) << lane;
  }
}

TEST(FullSolver, TellsPlanesFromUniqueQuadrics)
{
  QuadricFits fits = fitsOfWhichTwoAreNotUnique();
  for (std::size_t lane = 0; lane < kFitsAtOnce; ++lane) {
    fits.status[lane] = FitStatus::not_converged;
    fitQuadricFully(fits, lane);
    EXPECT_EQ(fits.status[lane], lane == 2 || lane == 5 ? FitStatus::not_unique : FitStatus::unique) << lane;
  }
}

TEST(FullSolver, FitsTheSameQuadricsAsTheKernels)
{
  for (std::size_t seed = 1; seed <= 20; ++seed) {
    QuadricFits fast = someFits(seed), full = fast;
    fitQuadrics(fast, kFitsAtOnce);
    for (std::size_t lane = 0; lane < kFitsAtOnce; ++lane) {
      fitQuadricFully(full, lane);
      ASSERT_EQ(full.status[lane], FitStatus::unique);
      EXPECT_NEAR(full.eigenvalue[lane], fast.eigenvalue[lane], 1e-9 * fast.eigenvalue[lane]);
      // Both are normalized by the gradient; which way it points is arbitrary.
      const double sign = full.coefficients[2][lane] * fast.coefficients[2][lane] < 0.0 ? -1.0 : 1.0;
      double difference = 0.0, norm = 0.0;
      for (std::size_t a = 0; a < full.coefficients.size(); ++a) {
        difference = std::hypot(difference, full.coefficients[a][lane] - sign * fast.coefficients[a][lane]);
        norm = std::hypot(norm, fast.coefficients[a][lane]);
      }
      EXPECT_LT(difference, 1e-9 * norm) << "seed " << seed << " lane " << lane;
    }
  }
}

TEST_P(Kernel, TakesCurvaturesOnTheQuadric)
{
  Random random(6);
  for (int trial = 0; trial < 50; ++trial) {
    Quadric quadric;
    quadric.A = random.rotation() *
                Eigen::Vector3d(random.uniform(0.3, 1.0), random.uniform(-1.0, 1.0), 0.1).asDiagonal() *
                random.rotation();
    quadric.A = (0.5 * (quadric.A + quadric.A.transpose())).eval();
    quadric.b = 0.7 * random.direction();
    quadric.c = random.uniform(-0.05, 0.05);
    const auto& A = quadric.A;
    const QuadricCoefficients coefficients{A(0, 0), A(1, 1),       A(2, 2),       A(0, 1),       A(1, 2),
                                           A(0, 2), quadric.b.x(), quadric.b.y(), quadric.b.z(), quadric.c};
    constexpr std::size_t kCount = 21, kRoom = 24;
    std::array<double, kRoom> x{}, y{}, z{}, squared{};
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < kCount; ++i) {
      points.emplace_back(random.uniform(0.0, 1.0) * random.direction());
      x[i] = points[i].x(), y[i] = points[i].y(), z[i] = points[i].z();
    }
    const double sensor[3] = {0.0, 0.0, -30.0};
    const CurvatureCounts counts =
        quadricCurvatures(coefficients, sensor, kCount, {x.data(), y.data(), z.data(), squared.data()});

    CurvatureCounts expected;
    for (std::size_t i = 0; i < kCount; ++i) {
      const Eigen::Vector3d gradient = quadric.gradient(points[i]);
      const Eigen::Vector3d p = points[i] - quadric.value(points[i]) / gradient.squaredNorm() * gradient;
      const PrincipalCurvature curvature = principalCurvature(quadric, p);
      if (!(p.squaredNorm() <= 1.0)) {
        EXPECT_EQ(squared[i], std::numeric_limits<double>::infinity());
        continue;
      }
      ++expected.valid;
      const bool seen_from_outside = quadric.gradient(p).dot(Eigen::Vector3d(0.0, 0.0, -30.0) - p) >= 0.0;
      expected.concave += (curvature.value < 0.0) == seen_from_outside ? 1 : 0;
      EXPECT_LT((Eigen::Vector3d(x[i], y[i], z[i]) - p).norm(), 1e-13);
      EXPECT_NEAR(std::sqrt(squared[i]), std::abs(curvature.value), 1e-7 * (1.0 + std::abs(curvature.value)));
    }
    EXPECT_EQ(counts.valid, expected.valid);
    EXPECT_EQ(counts.concave, expected.concave);
  }
}

}  // namespace
}  // namespace grasp_affordances::test
