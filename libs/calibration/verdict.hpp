// Result of a calibration for each parameter.
#pragma once

#include <string>
#include <vector>

namespace redbee::calibration {

enum class Verdict {
  kFound,          ///< accurate enough for the online stack
  kWeak,           ///< estimated, with a standard deviation larger than desired
  kRefused,        ///< not observable in the recording: the nominal value stays
  kNotApplicable,  ///< this kind of recording has no such parameter
};
const char* toString(Verdict verdict);

/// One parameter of one or more entries, all in the same unit.
struct ParameterReport {
  std::string name;  ///< as in the configuration where it has a key there: camera.R_CI
  std::string unit;
  std::vector<double> value;    ///< estimated; for R_CI the rotation vector from the nominal one, in C
  std::vector<double> sigma;    ///< one standard deviation each
  std::vector<double> nominal;  ///< as configured
  double worst_sigma = 0;       ///< along the least certain direction; relative to the value for the height
  double found_below = 0;       ///< limits for worst_sigma
  double weak_below = 0;
  Verdict verdict = Verdict::kRefused;
  std::string explanation;  ///< one sentence
};

/// Fills verdict and explanation from worst_sigma and its limits; `cause`: the excitation that is missing if
/// this parameter is not observable.
void classify(ParameterReport& report, const std::string& cause);

}  // namespace redbee::calibration
