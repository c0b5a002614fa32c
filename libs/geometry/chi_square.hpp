// Gates of the filters: the chi-square distribution's quantiles.
#pragma once

namespace redbee {

/// The value that a chi-square variable of this many degrees of freedom stays below with this probability.
/// 0 < probability < 1, degrees >= 1; exact to 1e-9.
double chiSquareQuantile(double probability, int degrees);

}  // namespace redbee
