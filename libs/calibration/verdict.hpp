// What a calibration says of each parameter, for people and for machines.
#pragma once

#include <string>
#include <vector>

namespace redbee::calibration {

enum class Verdict {
  kFound,          ///< as well as the online stack needs it
  kWeak,           ///< estimated, with a standard deviation that one should look at
  kRefused,        ///< the recording does not show it: the nominal value stays
  kNotApplicable,  ///< this kind of recording has no such parameter
};
const char* toString(Verdict verdict);

/// One parameter of one or more entries, all in the same unit.
struct ParameterReport {
  std::string name;  ///< as in the configuration where it has a key there: camera.R_CI
  std::string unit;
  std::vector<double> value;    ///< estimated; for R_CI the rotation vector from the nominal one, in C
  std::vector<double> sigma;    ///< one standard deviation each
  std::vector<double> nominal;  ///< what the configuration had
  double worst_sigma = 0;       ///< along the least certain direction; relative to the value for the height
  double found_below = 0;       ///< limits for worst_sigma
  double weak_below = 0;
  Verdict verdict = Verdict::kRefused;
  std::string words;  ///< one sentence
};

/// Fills verdict and words from worst_sigma and its limits; `cause` says what a recording lacks that does not
/// show this parameter.
void judge(ParameterReport& report, const std::string& cause);

}  // namespace redbee::calibration
