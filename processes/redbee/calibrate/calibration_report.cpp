#include "processes/redbee/calibrate/calibration_report.hpp"

#include <cmath>
#include <limits>

#include "processes/redbee/pages/number.hpp"
#include "processes/redbee/pages/page.hpp"
#include "processes/redbee/pages/svg_plot.hpp"
#include "redbee/bus/build_version.hpp"
#include "redbee/geometry/angle.hpp"

namespace redbee {
namespace {

using calibration::CalibrationInput;
using calibration::CalibrationResult;
using calibration::Diagnostics;
using calibration::HandEye;
using calibration::ParameterReport;
using calibration::RatePair;

constexpr const char* kAxisColours[] = {"#c0392b", "#1e8449", "#2471a3"};
constexpr const char* kBefore = "#d68910";
constexpr const char* kAfter = "#1f618d";

std::string rounded(double value) { return significant(value, 4); }

std::string list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + rounded(value);
  return text;
}

TextStyle styleFor(calibration::Verdict verdict) {
  switch (verdict) {
    case calibration::Verdict::kFound:
      return TextStyle::kGood;
    case calibration::Verdict::kWeak:
      return TextStyle::kWeak;
    case calibration::Verdict::kRefused:
      return TextStyle::kBad;
    case calibration::Verdict::kNotApplicable:
      return TextStyle::kPlain;
  }
  return TextStyle::kPlain;
}

Table parameterTable(const CalibrationResult& result) {
  Table table;
  table.columns = {"parameter", "value", "sigma", "nominal", "unit", "verdict", ""};
  table.text_columns = {0, 1, 2, 3, 4, 5, 6};
  for (const ParameterReport& report : result.parameters) {
    table.rows.push_back({report.name, list(report.value), list(report.sigma), list(report.nominal),
                          report.unit, Cell(toString(report.verdict), styleFor(report.verdict)),
                          report.explanation});
  }
  table.notes = {
      "camera.R_CI: rotation vector from the nominal to the estimated rotation, about the camera's axes."};
  return table;
}

Table recordingTable(const CalibrationResult& result) {
  const auto& excitation = result.excitation;
  const auto degrees = [](const Eigen::Vector3d& v) {
    return list({v(0) / kDegree, v(1) / kDegree, v(2) / kDegree});
  };
  Table table;
  table.text_columns = {0, 1};
  table.rows = {
      {"frames used / given", fmt::format("{} / {}", result.frames, result.frames_given)},
      {"measurements used", std::to_string(result.measurements)},
      {"duration", rounded(result.duration_s) + " s"},
      {"points about their own fit", rounded(result.points_rms_px) + " px rms"},
      {"rotation about its principal axes (singular values)", degrees(excitation.rotation) + " deg/s rms"},
      {"correlation of the turning rates", rounded(excitation.rotation_correlation)},
      {"acceleration of the drone itself", rounded(excitation.acceleration) + " m/s^2 rms"},
      {"sigma of R_CI along its principal directions", degrees(excitation.rotation_sigmas) + " deg"},
      {"scale of the measurements' sigmas (vision, IMU)",
       list({result.vision_sigma_scale, result.imu_sigma_scale})},
      {"scale of the reported sigmas (misfit of the scene, disagreement of the halves)",
       list({result.misfit_sigma_scale, result.halves_sigma_scale})}};
  return table;
}

Table splitHalfTable(const CalibrationResult& result) {
  Table table;
  if (result.split_half.empty()) {
    table.notes = {"Half of the recording is too short to be calibrated on its own."};
    return table;
  }
  table.columns = {"parameter", "difference", "its sigma", "unit", "ratio"};
  table.text_columns = {0, 3};
  for (const auto& entry : result.split_half) {
    table.rows.push_back(
        {entry.name, rounded(entry.difference), rounded(entry.sigma), entry.unit, rounded(entry.ratio())});
  }
  return table;
}

using Plots = std::vector<std::string>;

Plots ratePlots(const Diagnostics& diagnostics) {
  const HandEye& solution = diagnostics.alignment.hand_eye;
  const char* axes[] = {"x", "y", "z"};
  Plots plots;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> measured, predicted;
    for (const RatePair& pair : diagnostics.alignment.rates) {
      measured.push_back(pair.camera[axis] / kDegree);
      predicted.push_back((solution.R_CI * (pair.imu - solution.gyro_bias))[axis] / kDegree);
    }
    SvgPlot plot(std::string("Turning rate about the camera's ") + axes[axis], "s", "deg/s");
    plot.addLine("measured by vision", diagnostics.alignment.t_s, measured, kBefore);
    plot.addLine("predicted from the gyro", diagnostics.alignment.t_s, predicted, kAfter);
    plots.push_back(plot.svg());
  }
  return plots;
}

std::string rateResidualPlot(const CalibrationInput& input, const Diagnostics& diagnostics) {
  HandEye nominal;
  nominal.R_CI = input.nominal.R_CI;
  std::vector<double> before, after;
  for (const RatePair& pair : diagnostics.alignment.rates) {
    before.push_back(handEyeResidual(pair, nominal).norm() / kDegree);
    after.push_back(handEyeResidual(pair, diagnostics.alignment.hand_eye).norm() / kDegree);
  }
  SvgPlot plot("Residual of the turning rate, closed form", "s", "deg/s");
  plot.addLine("before (nominal rotation, no bias)", diagnostics.alignment.t_s, before, kBefore);
  plot.addLine("after", diagnostics.alignment.t_s, after, kAfter);
  return plot.svg();
}

Plots shiftPlots(const CalibrationResult& result) {
  const auto milliseconds = [](std::vector<double> values) {
    for (double& value : values) value *= 1e3;
    return values;
  };
  const auto& alignment = result.diagnostics.alignment;
  SvgPlot coarse("Correlation of the turning rates' magnitudes", "time shift, ms", "correlation");
  coarse.addLine("", milliseconds(alignment.correlation_curve.shift_s), alignment.correlation_curve.value,
                 kAfter);
  SvgPlot fine("Residual of the closed form over the time shift", "time shift, ms", "deg/s");
  std::vector<double> residual = alignment.residual_curve.value;
  for (double& value : residual) value /= kDegree;
  fine.addLine("", milliseconds(alignment.residual_curve.shift_s), residual, kAfter);
  fine.addMark("joint estimate", 1e3 * result.values.estimated.timeshift_s);
  return {coarse.svg(), fine.svg()};
}

std::string transferPlot(const Diagnostics& diagnostics, bool target) {
  SvgPlot plot(target ? "Predicted against measured pose of the target"
                      : "Predicted against measured homography of the ground",
               "s", "px");
  plot.addLine("before (nominal mounting and time shift)", diagnostics.pair_t_s,
               diagnostics.pair_error_before_px, kBefore);
  plot.addLine("after", diagnostics.pair_t_s, diagnostics.pair_error_after_px, kAfter);
  return plot.svg();
}

double quantile(const std::vector<Eigen::Vector2d>& points, double fraction) {
  if (points.empty()) return 1;
  std::vector<double> norms;
  norms.reserve(points.size());
  for (const Eigen::Vector2d& point : points) norms.push_back(point.norm());
  const auto place = norms.begin() + static_cast<ptrdiff_t>(fraction * static_cast<double>(norms.size() - 1));
  std::nth_element(norms.begin(), place, norms.end());
  return std::max(*place, 1e-3);
}

Plots scatterPlots(const Diagnostics& diagnostics) {
  const double reach = 1.3 * std::max(quantile(diagnostics.scatter_before_px, 0.9),
                                      quantile(diagnostics.scatter_after_px, 0.9));
  Plots plots;
  const auto add = [&](const char* title, const std::vector<Eigen::Vector2d>& points, const char* colour) {
    SvgPlot plot(title, "px", "px");
    plot.addPoints("", points, colour);
    plot.makeSquare(-reach, reach);
    plots.push_back(plot.svg());
  };
  add("Ground points before", diagnostics.scatter_before_px, kBefore);
  add("Ground points after", diagnostics.scatter_after_px, kAfter);
  return plots;
}

std::string biasPlot(const char* title, const char* unit, const std::vector<double>& t,
                     const std::vector<Eigen::Vector3d>& bias, double scale) {
  SvgPlot plot(title, "s", unit);
  const char* axes[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    values.reserve(bias.size());
    for (const Eigen::Vector3d& b : bias) values.push_back(b[axis] * scale);
    plot.addLine(axes[axis], t, values, kAxisColours[axis]);
  }
  return plot.svg();
}

std::string heightPlot(const CalibrationInput& input, const Diagnostics& diagnostics) {
  SvgPlot plot("Camera above the ground", "s", "m");
  std::vector<double> t, height;
  for (const AltitudeSample& sample : input.altimeter) {
    t.push_back(seconds(sample.time - toImu(input.frames.front(), Duration(0))));
    height.push_back(sample.height_m);
  }
  if (!t.empty()) plot.addLine("altimeter", t, height, kBefore);
  plot.addLine("estimate", diagnostics.frame_t_s, diagnostics.height_m, kAfter);
  return plot.svg();
}

}  // namespace

std::string calibrationReport(const CalibrationInput& input, const CalibrationResult& result,
                              const CalibrationSubject& subject) {
  const bool target = !input.target.empty();
  const Diagnostics& diagnostics = result.diagnostics;
  Page page(std::string("REDBEE ") + releaseVersion() + ": calibration of " + subject.vehicle);
  page.addParagraph("From " + subject.source);
  for (const std::string& warning : result.warnings)
    page.addParagraph("Warning: " + warning, TextStyle::kWeak);
  page.addHeading("Verdicts");
  page.addTable(parameterTable(result));
  page.addHeading("The recording");
  page.addTable(recordingTable(result));
  page.addHeading("First half against second half");
  page.addTable(splitHalfTable(result));
  if (diagnostics.alignment.possible) {
    page.addHeading("Rotation");
    Plots plots = ratePlots(diagnostics);
    plots.push_back(rateResidualPlot(input, diagnostics));
    page.addPlots(plots, 2);
    page.addHeading("Time shift");
    page.addPlots(shiftPlots(result), 2);
  }
  page.addHeading("Residuals before and after");
  page.addPlots({transferPlot(diagnostics, target)}, 2);
  if (!target) {
    page.addPlots(scatterPlots(diagnostics), 3);
    page.addHeading("Height");
    page.addPlots({heightPlot(input, diagnostics)}, 2);
  }
  page.addHeading("Biases");
  page.addPlots({biasPlot("Gyro bias", "deg/s", diagnostics.bias_t_s, diagnostics.gyro_bias, 1 / kDegree),
                 biasPlot("Accelerometer bias", "m/s^2", diagnostics.bias_t_s, diagnostics.accel_bias, 1)},
                2);
  return page.html();
}

}  // namespace redbee
