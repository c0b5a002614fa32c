#include "redbee/detection/appearance/appearance_model.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "redbee/detection/appearance/appearance_kernels.hpp"
#include "redbee/detection/appearance/shadow_test.hpp"
#include "redbee/imaging/float_rows.hpp"

namespace redbee {
namespace {

constexpr double kVarianceSpan_s = 0.4;

/// 1 / (age + 1), at least `slowest`.
RatesByAge ratesByAge(double slowest) {
  RatesByAge rates{};
  for (size_t age = 0; age < rates.size(); ++age) {
    const double rate = std::max(1.0 / (static_cast<double>(age) + 1), slowest);
    rates[age] = static_cast<float>(std::min(rate, 1.0));
  }
  return rates;
}

}  // namespace

void AppearanceModel::reset() { maps_ = {}; }

void AppearanceModel::propagate(const SceneMotion& scene, SpareMaps& spare) {
  if (maps_.model.empty()) return;
  cv::Mat4f& model = spare.ofSize(maps_.model.size());
  std::swap(warped_.model, model);
  warpBackground(maps_, scene, warped_);
  std::swap(maps_, warped_);
  std::swap(warped_.model, model);
}

SurfaceReset AppearanceModel::surfaceReset() const {
  const auto sigmas = static_cast<float>(evidence_sigmas_);
  return {parameters_.use_surface_reset, sigmas * sigmas};
}

cv::Mat1f AppearanceModel::appearanceDifference(const cv::Mat4b& image, const SurfaceSpeed& speed) const {
  if (maps_.model.empty()) return cv::Mat1f::zeros(image.size());
  cv::Mat1f evidence(image.size());
  const auto noise2 = static_cast<float>(parameters_.noise * parameters_.noise);
  const double edge_px = parameters_.edge_tolerance_px / std::max(parameters_.downscale, 1);
  const auto edge2 = static_cast<float>(edge_px * edge_px);
  std::optional<ShadowTest> shadows;
  FloatRows values(image);
  if (shadow_.enabled) shadows.emplace(values, maps_.model, shadow_.noise);
  const std::vector<float> none(static_cast<size_t>(image.cols), 0.0F);
  const auto modelRow = [&](int y) { return maps_.model.ptr<float>(std::clamp(y, 0, image.rows - 1)); };
  for (int y = 0; y < image.rows; ++y) {
    const std::vector<float>& shadow = shadows ? shadows->row(y) : none;
    const DifferenceRow row{static_cast<size_t>(image.cols),
                            values(y),
                            {modelRow(y - 1), modelRow(y), modelRow(y + 1)},
                            shadow.data(),
                            speed.ptr<float>(y),
                            maps_.speed[y],
                            maps_.age[y],
                            evidence[y]};
    differenceRow(row, noise2, edge2, surfaceReset());
  }
  return evidence;
}

void AppearanceModel::learn(const cv::Mat4b& image, const cv::Mat1f& moving, const SurfaceSpeed& speed,
                            double elapsed_s) {
  if (maps_.model.empty()) {
    maps_ = {cv::Mat4f::zeros(image.size()), cv::Mat1f::zeros(image.size()), cv::Mat1b::zeros(image.size())};
  }
  const RatesByAge mean_rates = ratesByAge(elapsed_s / parameters_.span_s);
  const RatesByAge variance_rates = ratesByAge(elapsed_s / kVarianceSpan_s);
  FloatRows values(image);
  for (int y = 0; y < image.rows; ++y) {
    learnRow({static_cast<size_t>(image.cols), values(y), moving[y], speed.ptr<float>(y),
              maps_.model.ptr<float>(y), maps_.speed[y], maps_.age[y]},
             mean_rates, variance_rates, surfaceReset());
  }
}

}  // namespace redbee
