#include "redbee/inertial/timeshift_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/median.hpp"
#include "redbee/geometry/small_decompositions.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee {
namespace {

constexpr size_t kMinRates = 50;
constexpr double kCoarseStep_s = 0.01;  // the rates of a drone change over more
constexpr int kIterations = 6;
constexpr double kMountingSigma = 2 * kDegree;
constexpr double kScaleSigma = 0.02;
constexpr size_t kBlocks = 10;
constexpr double kTrimmed = 0.8;  // of the rates count for the coarse search
constexpr double kOutlier = 3;    // robust standard deviations at which the weight is halved (Cauchy)
constexpr double kMedianToSigma = 1.4826;  // of a Gaussian's absolute deviations
constexpr double kSmallestSigma = 1e-6;    // rad/s, so that exact inputs have weights

/// shift, bias, mounting, scale
using Parameters = Vector8d;

struct NormalEquations {
  Matrix8d H = Matrix8d::Zero();
  Vector8d g = Vector8d::Zero();

  NormalEquations operator-(const NormalEquations& other) const { return {H - other.H, g - other.g}; }
  void operator+=(const NormalEquations& other) {
    H += other.H;
    g += other.g;
  }
  std::optional<Vector8d> solution() const {
    const LdltFactors factors(H);
    if (!factors.succeeded() || !factors.isPositive()) return std::nullopt;
    const Vector8d x = factors.solve(g);
    return x.allFinite() ? std::optional<Vector8d>(x) : std::nullopt;
  }
};

class Fit {
 public:
  Fit(const std::vector<VisualRate>& vision, const GyroIntegral& gyro, double max_shift_s) : gyro_(gyro) {
    const double reach_s = max_shift_s + kCoarseStep_s;
    for (const VisualRate& each : vision) {
      if (gyro.covers(each.from_s - reach_s, each.to_s + reach_s)) vision_.push_back(each);
    }
  }
  size_t size() const { return vision_.size(); }

  /// Variance of vision's rates minus the gyro's; a bias is none.
  double variance(double shift_s) const {
    return varianceOf([&](const VisualRate& v) {
      return Eigen::Vector3d(v.rate - gyro_.meanRate(v.from_s + shift_s, v.to_s + shift_s));
    });
  }
  double variance() const {
    return varianceOf([](const VisualRate& v) { return v.rate; });
  }

  Eigen::Vector3d residual(const VisualRate& v, const Parameters& p) const {
    return v.rate - predicted(gyro_.meanRate(v.from_s + p[0], v.to_s + p[0]), p);
  }
  /// Robust standard deviation of the residuals, by axis.
  Eigen::Vector3d sigmas(const Parameters& p) const {
    Eigen::Vector3d sigma;
    std::vector<double> deviations(size());
    for (int axis = 0; axis < 3; ++axis) {
      for (size_t i = 0; i < size(); ++i) deviations[i] = std::abs(residual(vision_[i], p)[axis]);
      sigma[axis] = std::max(kMedianToSigma * median(deviations), kSmallestSigma);
    }
    return sigma;
  }

  std::array<NormalEquations, kBlocks> blocks(const Parameters& p, const Eigen::Vector3d& sigma) const {
    std::array<NormalEquations, kBlocks> blocks;
    for (size_t i = 0; i < size(); ++i) add(blocks[i * kBlocks / size()], vision_[i], p, sigma);
    return blocks;
  }

 private:
  static Eigen::Vector3d predicted(const Eigen::Vector3d& gyro, const Parameters& p) {
    const Eigen::Vector3d mounting = p.segment<3>(4);
    return (1 + p[7]) * gyro + mounting.cross(gyro) + p.segment<3>(1);
  }
  /// About the median, without the part that outliers may have.
  template <typename Value>
  double varianceOf(const Value& value) const {
    std::vector<Eigen::Vector3d> values(size());
    std::transform(vision_.begin(), vision_.end(), values.begin(), value);
    Eigen::Vector3d middle;
    std::vector<double> numbers(size());
    for (int axis = 0; axis < 3; ++axis) {
      for (size_t i = 0; i < size(); ++i) numbers[i] = values[i][axis];
      middle[axis] = median(numbers);
    }
    for (size_t i = 0; i < size(); ++i) numbers[i] = (values[i] - middle).squaredNorm();
    const auto kept = numbers.begin() + static_cast<std::ptrdiff_t>(kTrimmed * static_cast<double>(size()));
    std::nth_element(numbers.begin(), kept, numbers.end());
    return std::accumulate(numbers.begin(), kept, 0.0) / static_cast<double>(kept - numbers.begin());
  }

  void add(NormalEquations& equations, const VisualRate& v, const Parameters& p,
           const Eigen::Vector3d& sigma) const {
    const Eigen::Vector3d gyro = gyro_.meanRate(v.from_s + p[0], v.to_s + p[0]);
    Eigen::Matrix<double, 3, 8> J;
    J.col(0) = gyro_.meanAcceleration(v.from_s + p[0], v.to_s + p[0]);
    J.middleCols<3>(1) = Eigen::Matrix3d::Identity();
    J.middleCols<3>(4) = -skew(gyro);
    J.col(7) = gyro;
    const Eigen::Vector3d r = v.rate - predicted(gyro, p);
    for (int axis = 0; axis < 3; ++axis) {
      const double size = std::abs(r[axis]) / sigma[axis];
      const double weight = 1 / ((1 + std::pow(size / kOutlier, 2)) * sigma[axis] * sigma[axis]);
      equations.H += weight * J.row(axis).transpose() * J.row(axis);
      equations.g += weight * r[axis] * J.row(axis).transpose();
    }
  }

  std::vector<VisualRate> vision_;
  const GyroIntegral& gyro_;
};

/// What is known of mounting and scale before.
NormalEquations prior(const Parameters& p) {
  Vector8d weight = Vector8d::Zero();
  weight.segment<3>(4).setConstant(1 / (kMountingSigma * kMountingSigma));
  weight[7] = 1 / (kScaleSigma * kScaleSigma);
  return {Matrix8d(weight.asDiagonal()), Vector8d(-weight.cwiseProduct(p))};
}

double jackknife(const NormalEquations& all, const std::array<NormalEquations, kBlocks>& blocks) {
  std::array<double, kBlocks> without{};
  double mean = 0;
  for (size_t k = 0; k < kBlocks; ++k) {
    const auto x = (all - blocks[k]).solution();
    if (!x) return INFINITY;
    without[k] = (*x)[0];
    mean += without[k] / kBlocks;
  }
  double squares = 0;
  for (const double value : without) squares += (value - mean) * (value - mean);
  return std::sqrt((kBlocks - 1.0) / kBlocks * squares);
}

std::optional<double> coarse(const Fit& fit, const TimeshiftFitOptions& options) {
  const int steps = static_cast<int>(std::floor(options.max_shift_s / kCoarseStep_s));
  int best = 0;
  double least = options.max_unexplained * fit.variance();
  bool is_explained = false;
  for (int i = -steps; i <= steps; ++i) {
    const double value = fit.variance(i * kCoarseStep_s);
    if (!(value < least)) continue;
    is_explained = true;
    least = value;
    best = i;
  }
  if (!is_explained || std::abs(best) == steps) return std::nullopt;
  return best * kCoarseStep_s;
}

}  // namespace

std::optional<TimeshiftFit> fitTimeshift(const std::vector<VisualRate>& vision, const GyroIntegral& gyro,
                                         const TimeshiftFitOptions& options) {
  const Fit fit(vision, gyro, options.max_shift_s);
  if (fit.size() < kMinRates) return std::nullopt;
  const std::optional<double> start = coarse(fit, options);
  if (!start) return std::nullopt;
  Parameters p = Parameters::Zero();
  p[0] = *start;
  for (int i = 0;; ++i) {
    const auto blocks = fit.blocks(p, fit.sigmas(p));
    NormalEquations all = prior(p);
    for (const NormalEquations& block : blocks) all += block;
    const auto step = all.solution();
    if (!step) return std::nullopt;
    if (i == kIterations) {
      const double formal = std::sqrt(LdltFactors(all.H).inverse()(0, 0));
      return TimeshiftFit{p[0], std::max(formal, jackknife(all, blocks))};
    }
    p += *step;
    if (std::abs(p[0]) > options.max_shift_s) return std::nullopt;
  }
}

}  // namespace redbee
