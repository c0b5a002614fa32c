#include "redbee/mosaic/georeference.hpp"

#include <cmath>
#include <complex>

namespace redbee {
namespace {

constexpr double kSamePlace =
    1e-9;  ///< spread of the map's points, relative to their distance from its origin

std::complex<double> onMap(const GroundTie& tie) { return {tie.on_map.x(), -tie.on_map.y()}; }
std::complex<double> placeOf(const GroundTie& tie) { return {tie.place.x(), tie.place.y()}; }

}  // namespace

std::optional<Georeference> georeference(const std::vector<GroundTie>& ties) {
  double weights = 0;
  double size2 = 0;
  std::complex<double> map_mean, place_mean;
  const auto weightOf = [](const GroundTie& tie) { return 1 / (tie.sigma_m * tie.sigma_m); };
  for (const GroundTie& tie : ties) {
    weights += weightOf(tie);
    map_mean += weightOf(tie) * onMap(tie);
    place_mean += weightOf(tie) * placeOf(tie);
    size2 += weightOf(tie) * std::norm(onMap(tie));
  }
  if (!(weights > 0) || !std::isfinite(weights)) return std::nullopt;
  map_mean /= weights;
  place_mean /= weights;
  std::complex<double> product;
  double spread = 0;
  for (const GroundTie& tie : ties) {
    product += weightOf(tie) * std::conj(onMap(tie) - map_mean) * (placeOf(tie) - place_mean);
    spread += weightOf(tie) * std::norm(onMap(tie) - map_mean);
  }
  if (!(spread > kSamePlace * size2) || !(std::abs(product) > 0)) return std::nullopt;
  const std::complex<double> turn = product / spread;
  const std::complex<double> offset = place_mean - turn * map_mean;
  Georeference result;
  result.turn_and_scale << turn.real(), turn.imag(), turn.imag(), -turn.real();
  result.offset = {offset.real(), offset.imag()};
  result.scale = std::abs(turn);
  double squares = 0;
  for (const GroundTie& tie : ties)
    squares += weightOf(tie) * (result.placeOf(tie.on_map) - tie.place).squaredNorm();
  result.residual_m = std::sqrt(squares / weights);
  return result;
}

}  // namespace redbee
