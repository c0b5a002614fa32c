#include "redbee/geometry/chi_square.hpp"

#include <cmath>

namespace redbee {
namespace {

/// Cumulative distribution: the regularised lower incomplete gamma function by its power series.
double cumulative(double x, int degrees) {
  const double a = 0.5 * degrees;
  const double y = 0.5 * x;
  if (y <= 0) return 0;
  if (y > a + 40 * std::sqrt(a) + 300) return 1;  // and the series would overflow
  double term = 1.0 / a;
  double sum = term;
  for (int n = 1; n < 10000 && term > 1e-16 * sum; ++n) {
    term *= y / (a + n);
    sum += term;
  }
  return sum * std::exp(a * std::log(y) - y - std::lgamma(a));
}

}  // namespace

double chiSquareQuantile(double probability, int degrees) {
  double low = 0;
  double high = degrees + 10.0;
  while (cumulative(high, degrees) < probability && high < 1e4) high *= 2;
  while (high - low > 1e-10 * high) {
    const double middle = 0.5 * (low + high);
    (cumulative(middle, degrees) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace redbee
