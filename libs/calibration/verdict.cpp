#include "redbee/calibration/verdict.hpp"

#include <cmath>
#include <cstdio>

namespace redbee::calibration {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

}  // namespace

const char* toString(Verdict verdict) {
  switch (verdict) {
    case Verdict::kFound:
      return "found";
    case Verdict::kWeak:
      return "weak";
    case Verdict::kRefused:
      return "refused";
    case Verdict::kNotApplicable:
      return "not_applicable";
  }
  return "unknown";
}

void classify(ParameterReport& report, const std::string& cause) {
  const std::string spread = number(report.worst_sigma) + " " + report.unit;
  if (std::isfinite(report.worst_sigma) && report.worst_sigma <= report.found_below) {
    report.verdict = Verdict::kFound;
    report.explanation = "accurate to " + spread;
  } else if (std::isfinite(report.worst_sigma) && report.worst_sigma <= report.weak_below) {
    report.verdict = Verdict::kWeak;
    report.explanation = "estimated, but only to " + spread + "; a better recording would have more " + cause;
  } else {
    report.verdict = Verdict::kRefused;
    report.explanation =
        "not observable in this recording (" + spread + "): it lacks " + cause + "; the nominal value stays";
  }
}

}  // namespace redbee::calibration
