#include "redbee/detection/objects/log_odds.hpp"

#include <algorithm>
#include <cmath>

namespace redbee {
namespace {

constexpr double kSurest = 0.95;    // what is surer than this, either way, is no better evidence
constexpr double kSettled_s = 0.5;  // age from which it counts that a track stays
constexpr double kLeftPlace = 2;
constexpr double kStayedLogOdds = -1;  // at worst
constexpr double kFreedomLogOdds = 1;  // expected where nothing moves: the velocity has one freedom more

}  // namespace

double logOdds(double probability) {
  const double p = std::clamp(probability, 1 - kSurest, kSurest);
  return std::log(p / (1 - p));
}

double gainLogOdds(double gain) {
  constexpr double kMost = kSurest / (1 - kSurest);
  return std::log(std::clamp(gain, 1 / kMost, kMost));
}

double restlessLogOdds(double squared_residual) { return -0.5 * std::log(std::max(1.0, squared_residual)); }

double stayedLogOdds(double age_s, double farthest) {
  if (age_s < kSettled_s || farthest >= kLeftPlace) return 0;
  return std::max(std::log(farthest / kLeftPlace), kStayedLogOdds);
}

double movingLogOdds(double age_s, double log_likelihood_ratio) {
  const double odds = std::min(log_likelihood_ratio - kFreedomLogOdds, logOdds(kSurest));
  return std::max(odds, age_s < kSettled_s ? 0 : kStayedLogOdds);
}

}  // namespace redbee
