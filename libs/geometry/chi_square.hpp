// Quantiles of the chi-square distribution, for the filters' gates.
#pragma once

namespace redbee {

/// The value that a chi-square variable with `degrees` degrees of freedom does not exceed with `probability`.
/// 0 < probability < 1, degrees >= 1; exact to 1e-9.
double chiSquareQuantile(double probability, int degrees);

}  // namespace redbee
