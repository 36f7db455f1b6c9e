#pragma once

#include "core/neighborhoods/neighborhoods.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>

namespace grasp_affordances
{

/// Sums over a neighborhood's points of the 35 monomials x^i y^j z^k of degree at most 4. Coordinates are centred on
/// the neighborhood and scaled by its radius. The Taubin fit needs nothing else of the points.
class Moments
{
public:
  static constexpr int kCount = 35;

  /// The moments of no points: zeros.
  Moments() = default;

  /// One pass over the points, in double precision. The neighborhood's radius must be above zero. Sums of a degree
  /// above `degree` (2, 3 or 4) stay zero.
  explicit Moments(const Neighborhood& neighborhood, int degree = 4);

  /// The sum of x^i y^j z^k; i + j + k <= 4. sum(0, 0, 0) is the number of points.
  double sum(int i, int j, int k) const;

  /// All of them: graded by degree, then by k, then by j.
  const std::array<double, kCount>& sums() const { return sums_; }

private:
  std::array<double, kCount> sums_{};
};

/// A quadratic surface x'Ax + b'x + c = 0 (paper, equation 1), in the local coordinates x = (p - origin) / scale of the
/// neighborhood that it was fitted to. So coefficients and values have no unit.
struct Quadric
{
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();  ///< symmetric
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double c = 0.0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m, in the cloud's frame
  double scale = 1.0;                                ///< m

  double value(const Eigen::Vector3d& x) const { return x.dot(A * x + b) + c; }
  Eigen::Vector3d gradient(const Eigen::Vector3d& x) const { return 2.0 * (A * x) + b; }
  Eigen::Matrix3d hessian() const { return 2.0 * A; }

  /// Local coordinates of a point of the cloud, and back.
  Eigen::Vector3d toLocal(const Eigen::Vector3d& p) const { return (p - origin) / scale; }
  Eigen::Vector3d toCloud(const Eigen::Vector3d& x) const { return origin + scale * x; }
};

struct TaubinFit
{
  Quadric quadric;
  /// Smallest eigenvalue: mean of f^2 over mean of |grad f|^2. Its square root times the quadric's scale approximates
  /// the RMS distance (m) of the points from the surface.
  double residual = 0.0;
};

/// Taubin's fit (paper, section III-A): minimises the sum of f^2 over the points, with the sum of |grad f|^2 fixed.
/// That is the generalized eigenproblem (M - lambda N) c = 0, smallest eigenvalue. The constant term has no gradient:
/// it is eliminated by its Schur complement, which leaves 9 x 9 matrices.
///
/// Empty where the points determine no unique quadric: where N is singular. Points on a plane make it so, since their
/// plane times any other plane fits. A plane through two coordinate axes counts as exact where the points are within an
/// RMS distance of 5e-6 of the radius; the more a plane is inclined to the axes, the smaller is that distance. Points
/// on a line, coincident points and fewer than nine points make N singular, too.
std::optional<TaubinFit> fitTaubin(const Neighborhood& neighborhood);

/// The same from moments of the neighborhood with the given centre and radius.
std::optional<TaubinFit> fitTaubin(const Moments& moments, const Eigen::Vector3d& origin, double scale);

/// Taubin's fit to several neighborhoods at once, each in a lane of the processor's registers. Many times faster than
/// one after another, with the same bits as fitTaubin(). One instance serves one thread at a time.
class TaubinFitter
{
public:
  static constexpr std::size_t kCapacity = 8;

  TaubinFitter();
  ~TaubinFitter();
  TaubinFitter(TaubinFitter&&) noexcept;
  TaubinFitter& operator=(TaubinFitter&&) noexcept;

  std::size_t size() const;

  /// Starts over with no neighborhoods.
  void clear();

  /// Adds the moments, of degree 4, of a neighborhood with the given centre and radius (m). At most kCapacity.
  void add(const Moments& moments, const Eigen::Vector3d& origin, double scale);

  /// Fits all that were added.
  void fit();

  /// The fit to the i-th neighborhood; empty where its points determine no unique quadric. After fit().
  std::optional<TaubinFit> operator[](std::size_t i) const;

  /// Number of fits so far for which the iteration did not converge and the full eigenproblem was solved.
  std::size_t solvedFully() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace grasp_affordances
