#include "core/fit/quadric.h"

#include "io/pcd.h"
#include "support/points.h"
#include "support/recordings.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <limits>
#include <optional>
#include <string>

namespace grasp_affordances::test
{
namespace
{

constexpr double kRadius = 0.026;  // m, of the neighborhoods

/// An analytic surface around the origin: points on it, and the distance from it.
struct Surface
{
  std::string name;
  Points (*points)(double size, std::size_t count, Random& random);
  double (*distance)(double size, const Eigen::Vector3d& p);  // to first order
};

Points withinUnitSphere(const Points& points, const Eigen::Vector3d& center)
{
  Points kept;
  for (const Eigen::Vector3d& p : points) {
    if ((p - center).norm() < kRadius) {
      kept.push_back(p);
    }
  }
  return kept;
}

const Surface kCylinder{
    "cylinder",
    [](double size, std::size_t count, Random& random) { return cylinderPoints(size, M_PI, 0.05, count, random); },
    [](double size, const Eigen::Vector3d& p) { return p.head<2>().norm() - size; }};

const Surface kSphere{"sphere",
                      [](double size, std::size_t count, Random& random) {
                        Points points;
                        for (std::size_t i = 0; i < count; ++i) {
                          Eigen::Vector3d d = random.direction();
                          d.y() = -std::abs(d.y());
                          points.push_back(size * d);
                        }
                        return points;
                      },
                      [](double size, const Eigen::Vector3d& p) { return p.norm() - size; }};

const Eigen::Vector3d kSemiAxes(1.0, 1.5, 0.7);  // of the ellipsoid, relative to its size

const Surface kEllipsoid{"ellipsoid",
                         [](double size, std::size_t count, Random& random) {
                           Points points;
                           for (std::size_t i = 0; i < count; ++i) {
                             Eigen::Vector3d d = random.direction();
                             d.y() = -std::abs(d.y());
                             points.push_back(size * kSemiAxes.cwiseProduct(d));
                           }
                           return points;
                         },
                         [](double size, const Eigen::Vector3d& p) {
                           const Eigen::Vector3d q = p.cwiseQuotient(size * kSemiAxes);
                           const Eigen::Vector3d gradient = 2 * q.cwiseQuotient(size * kSemiAxes);
                           return (q.squaredNorm() - 1) / gradient.norm();
                         }};

const Surface kSaddle{"saddle",
                      [](double size, std::size_t count, Random& random) {
                        Points points;
                        for (std::size_t i = 0; i < count; ++i) {
                          const double x = random.uniform(-0.02, 0.02), z = random.uniform(-0.02, 0.02);
                          points.emplace_back(x, (x * x - z * z) / (2 * size) - size, z);
                        }
                        return points;
                      },
                      [](double size, const Eigen::Vector3d& p) {
                        const double height = p.y() + size - (p.x() * p.x() - p.z() * p.z()) / (2 * size);
                        return height / Eigen::Vector3d(p.x() / size, 1, p.z() / size).norm();
                      }};

const Surface kCorner{
    "corner",
    [](double size, std::size_t count, Random& random) {
      Points points;
      for (std::size_t i = 0; i < count; ++i) {
        const double along = random.uniform(0, 0.02), z = random.uniform(-0.02, 0.02);
        points.emplace_back(i % 2 == 0 ? Eigen::Vector3d(along, -size, z) : Eigen::Vector3d(0, -size + along, z));
      }
      return points;
    },
    [](double size, const Eigen::Vector3d& p) {
      return std::abs(p.x()) < std::abs(p.y() + size) ? p.x() : p.y() + size;
    }};

class AnalyticSurface : public testing::TestWithParam<Surface>
{
};

TEST_P(AnalyticSurface, IsRecoveredAtAnySizePlaceAndOrientation)
{
  Random random(7);
  for (const double size : {0.01, 0.02, 0.04}) {
    for (const double distance : {0.5, 3.0}) {
      const Eigen::Vector3d top(0, -size, 0);
      const Points local = withinUnitSphere(GetParam().points(size, 1500, random), top);
      ASSERT_GT(local.size(), 200U);
      const Eigen::Matrix3d rotation = random.rotation();
      const Eigen::Vector3d place = distance * random.direction();
      const Neighborhood neighborhood =
          neighborhoodOf(transformed(local, rotation, place), rotation * top + place, 1.1 * kRadius);
      const auto fit = fitTaubin(neighborhood);
      ASSERT_TRUE(fit) << "size " << size << " distance " << distance;

      // The coordinates themselves are rounded to a part in 2^24 of the distance.
      const double rounding = distance * 0x1p-24;
      EXPECT_LT(std::sqrt(fit->residual) * kRadius, 2 * rounding) << "size " << size << " distance " << distance;
      for (std::size_t i = 0; i < local.size(); i += 10) {
        const Quadric& quadric = fit->quadric;
        const Eigen::Vector3d x = quadric.toLocal(rotation * local[i] + place);
        const double gradient = quadric.gradient(x).norm();
        if (gradient > 0.05) {  // not at the edge of the corner, where it vanishes
          EXPECT_LT(std::abs(quadric.value(x)) / gradient * quadric.scale, 100 * rounding);
        }
      }
    }
  }
}

TEST_P(AnalyticSurface, IsRecoveredFromNoisyPoints)
{
  constexpr double kNoise = 0.0005;  // m, standard deviation per coordinate: an Xtion at 0.6 m
  Random random(11);
  const double size = 0.02;
  const Eigen::Vector3d top(0, -size, 0);
  Points local = withinUnitSphere(GetParam().points(size, 3000, random), top);
  for (Eigen::Vector3d& p : local) {
    p += kNoise * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  }
  const Eigen::Matrix3d rotation = random.rotation();
  const Eigen::Vector3d place(0.1, -0.2, 0.8);
  const auto fit =
      fitTaubin(neighborhoodOf(transformed(local, rotation, place), rotation * top + place, 1.1 * kRadius));
  ASSERT_TRUE(fit);

  // Points of the fitted surface near the measured ones lie on the true surface. With hundreds of points for nine
  // unknowns the surface is known to a few tenths of the noise; the corner's edge is rounded by as much as the noise.
  double sum = 0;
  int count = 0;
  for (const Eigen::Vector3d& p : local) {
    Eigen::Vector3d x = fit->quadric.toLocal(rotation * p + place);
    for (int step = 0; step < 3; ++step) {
      const Eigen::Vector3d gradient = fit->quadric.gradient(x);
      x -= fit->quadric.value(x) / gradient.squaredNorm() * gradient;
    }
    const Eigen::Vector3d foot = rotation.transpose() * (fit->quadric.toCloud(x) - place);
    sum += std::pow(GetParam().distance(size, foot), 2);
    ++count;
  }
  EXPECT_LT(std::sqrt(sum / count), kNoise);
  EXPECT_NEAR(std::sqrt(fit->residual) * fit->quadric.scale, kNoise, 0.25 * kNoise);
}

INSTANTIATE_TEST_SUITE_P(Taubin, AnalyticSurface, testing::Values(kCylinder, kSphere, kEllipsoid, kSaddle, kCorner),
                         [](const testing::TestParamInfo<Surface>& info) { return info.param.name; });

/// Rounds to a grid that single precision represents exactly up to 4 m.
Eigen::Vector3d onGrid(const Eigen::Vector3d& p)
{
  return (p * 0x1p21).array().round().matrix() * 0x1p-21;
}

TEST(TaubinFit, IsAsExactFarFromTheOriginAsNear)
{
  Random random(3);
  Points points = cylinderPoints(0.02, M_PI, 0.04, 600, random, 0.0005);
  for (Eigen::Vector3d& p : points) {
    p = onGrid(p);
  }
  const Eigen::Vector3d top = onGrid({0, -0.02, 0});
  const Eigen::Vector3d near = onGrid({0.0, 0.0, 0.5}), far = onGrid({0.4, -0.3, 3.0});
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  const auto a = fitTaubin(neighborhoodOf(transformed(points, identity, near), top + near, kRadius));
  const auto b = fitTaubin(neighborhoodOf(transformed(points, identity, far), top + far, kRadius));
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->residual, b->residual);
  EXPECT_TRUE(a->quadric.A == b->quadric.A);
}

Points planePoints(std::size_t count, double noise, Random& random)
{
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02), 1.0 + noise * random.normal());
  }
  return points;
}

TEST(DegenerateNeighborhood, HasNoFit)
{
  Random random(5);
  const Eigen::Vector3d center(0, 0, 1);
  const Points plane = planePoints(500, 0.0, random);
  EXPECT_FALSE(fitTaubin(neighborhoodOf(plane, center, kRadius))) << "coplanar";

  Points line, same, few;
  for (int i = 0; i < 100; ++i) {
    line.emplace_back(0.0002 * i - 0.01, 0.0001 * i, 1.0 + 0.0001 * i);
    same.emplace_back(center);
  }
  few.assign(plane.begin(), plane.begin() + 8);
  EXPECT_FALSE(fitTaubin(neighborhoodOf(line, center, kRadius))) << "collinear";
  EXPECT_FALSE(fitTaubin(neighborhoodOf(same, center, kRadius))) << "coincident";
  EXPECT_FALSE(fitTaubin(neighborhoodOf(few, center, kRadius))) << "fewer points than unknowns";
  EXPECT_FALSE(fitTaubin(neighborhoodOf({}, center, kRadius))) << "no points";
  EXPECT_FALSE(fitTaubin(neighborhoodOf(plane, center, 0.0))) << "no radius";
}

TEST(DegenerateNeighborhood, PairOfSheetsIsThePairOfPlanes)
{
  Random random(6);
  Points points = planePoints(600, 0.0, random);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].z() += i % 2 == 0 ? 0x1p-9 : -0x1p-9;  // exact in single precision
  }
  const auto fit = fitTaubin(neighborhoodOf(points, {0, 0, 1}, kRadius));
  ASSERT_TRUE(fit);
  EXPECT_LT(fit->residual, 1e-15);
  const double height = 0x1p-9 / fit->quadric.scale;
  EXPECT_NEAR(fit->quadric.c / fit->quadric.A(2, 2), -height * height, 1e-9);
}

TEST(TaubinFit, NoisyPlaneHasTheNoiseAsResidual)
{
  Random random(8);
  const double noise = 0.001;
  const auto fit = fitTaubin(neighborhoodOf(planePoints(2000, noise, random), {0, 0, 1}, 0.03));
  ASSERT_TRUE(fit);
  // The pair of sheets at a standard deviation from the plane, of residual sigma^2 / 2, is the best quadric.
  EXPECT_NEAR(std::sqrt(fit->residual) * fit->quadric.scale, noise / std::sqrt(2.0), 0.1 * noise);
}

/// The paper's 10 x 10 problem taken literally, in long double, by the QZ method.
struct GeneralFit
{
  Eigen::Matrix<double, 10, 1> coefficients;  // unit
  double first, second;                       // the two smallest eigenvalues
};

GeneralFit fitByGeneralSolver(const Neighborhood& neighborhood)
{
  using Matrix = Eigen::Matrix<long double, 10, 10>;
  using Vector = Eigen::Matrix<long double, 10, 1>;
  Matrix M = Matrix::Zero(), N = Matrix::Zero();
  for (std::size_t i = 0; i < neighborhood.size(); ++i) {
    const Eigen::Matrix<long double, 3, 1> p =
        (neighborhood.point(i).cast<long double>() - neighborhood.center.cast<long double>()) / neighborhood.radius;
    const long double x = p.x(), y = p.y(), z = p.z();
    Vector l, lx, ly, lz;
    l << x * x, y * y, z * z, x * y, y * z, x * z, x, y, z, 1;
    lx << 2 * x, 0, 0, y, 0, z, 1, 0, 0, 0;
    ly << 0, 2 * y, 0, x, z, 0, 0, 1, 0, 0;
    lz << 0, 0, 2 * z, 0, y, x, 0, 0, 1, 0;
    M += l * l.transpose();
    N += lx * lx.transpose() + ly * ly.transpose() + lz * lz.transpose();
  }
  using AnyMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;  // compiles faster than of fixed size
  const Eigen::GeneralizedEigenSolver<AnyMatrix> solver(M, N);
  GeneralFit fit{{}, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  int best = 0;
  for (int i = 0; i < 10; ++i) {
    if (std::abs(solver.betas()[i]) < 1e-14L) {
      continue;  // the infinite eigenvalue, of the constant
    }
    const auto value = static_cast<double>(solver.alphas()[i].real() / solver.betas()[i]);
    if (value < fit.first) {
      fit.second = fit.first;
      fit.first = value;
      best = i;
    } else if (value < fit.second) {
      fit.second = value;
    }
  }
  fit.coefficients = solver.eigenvectors().col(best).real().cast<double>().normalized();
  return fit;
}

Eigen::Matrix<double, 10, 1> coefficientsOf(const Quadric& q)
{
  Eigen::Matrix<double, 10, 1> c;
  c << q.A(0, 0), q.A(1, 1), q.A(2, 2), 2 * q.A(0, 1), 2 * q.A(1, 2), 2 * q.A(0, 2), q.b, q.c;
  return c.normalized();
}

/// Compares random neighborhoods of a cloud; returns how many had eigenvalues apart.
int compareWithGeneralSolver(const Cloud& cloud, int count, std::uint64_t seed)
{
  int apart = 0;
  for (int i = 0, tries = 0; i < count && tries < 50 * count; ++tries) {
    const std::uint32_t point = randomIndex(randomBits(seed, tries), static_cast<std::uint32_t>(cloud.size()));
    if (!cloud.measured(point)) {
      continue;
    }
    const Neighborhood neighborhood = bruteForceNeighborhood(cloud, cloud.point(point), 0.026F);
    const auto fit = neighborhood.size() < 30 ? std::nullopt : fitTaubin(neighborhood);
    if (!fit) {
      continue;
    }
    ++i;
    const GeneralFit oracle = fitByGeneralSolver(neighborhood);
    EXPECT_NEAR(fit->residual, oracle.first, 1e-9 * oracle.second) << "seed " << seed << " point " << point;
    if (oracle.second - oracle.first < 1e-3 * oracle.second) {
      continue;
    }
    ++apart;
    const Eigen::Matrix<double, 10, 1> c = coefficientsOf(fit->quadric);
    const double sine = (c - c.dot(oracle.coefficients) * oracle.coefficients).norm();
    EXPECT_LT(sine, 1e-6) << "seed " << seed << " point " << point;
  }
  return apart;
}

TEST(GeneralizedEigenproblem, AgreesWithTheGeneralSolverOnRenderedClouds)
{
  for (const std::uint64_t seed : {1, 2}) {
    const Cloud cloud = captureScene("table", seed).cloud;
    EXPECT_GT(compareWithGeneralSolver(cloud, 250, seed), 200);
  }
}

TEST(GeneralizedEigenproblem, AgreesWithTheGeneralSolverOnRecordedClouds)
{
  REQUIRE_RECORDINGS(folder);
  for (const char* name : {"learn33", "learn44", "learn5", "learn40"}) {
    const Cloud cloud = readPcdCloud(folder + "/mosd/" + name + ".pcd");
    EXPECT_GT(compareWithGeneralSolver(cloud, 125, 9), 100) << name;
  }
}

}  // namespace
}  // namespace grasp_affordances::test
