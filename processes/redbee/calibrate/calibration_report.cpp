#include "processes/redbee/calibrate/calibration_report.hpp"

#include <cmath>
#include <cstdio>
#include <limits>
#include <sstream>

#include "processes/redbee/pages/svg_plot.hpp"
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
constexpr const char* kStyle =
    "body{font:15px/1.5 sans-serif;max-width:960px;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse}td,th{padding:.25em .8em;border-bottom:1px solid #ddd;text-align:left}"
    ".found{color:#1e8449}.weak{color:#b9770e}.refused{color:#c0392b}h1{font-size:1.4em}h2{font-size:1.1em}";

std::string brief(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + brief(value);
  return text;
}

std::string parameterTable(const CalibrationResult& result) {
  std::ostringstream out;
  out << "<table><tr><th>parameter</th><th>value</th><th>sigma</th><th>nominal</th><th>unit</th><th>verdict</"
         "th></tr>\n";
  for (const ParameterReport& report : result.parameters) {
    const std::string status = toString(report.verdict);
    out << "<tr><td>" << report.name << "</td><td>" << list(report.value) << "</td><td>" << list(report.sigma)
        << "</td><td>" << list(report.nominal) << "</td><td>" << report.unit << "</td><td><b class=\""
        << status << "\">" << status << "</b>: " << report.explanation << "</td></tr>\n";
  }
  out << "</table>\n<p>camera.R_CI: rotation vector from the nominal to the estimated rotation, about the "
         "camera's axes.</p>\n";
  return out.str();
}

std::string factsTable(const CalibrationResult& result) {
  const auto& excitation = result.excitation;
  std::ostringstream out;
  const auto row = [&](const char* name, const std::string& value) {
    out << "<tr><td>" << name << "</td><td>" << value << "</td></tr>\n";
  };
  out << "<table>\n";
  row("frames used / given", std::to_string(result.frames) + " / " + std::to_string(result.frames_given));
  row("measurements used", std::to_string(result.measurements));
  row("duration", brief(result.duration_s) + " s");
  row("points about their own fit", brief(result.points_rms_px) + " px rms");
  row("rotation about its principal axes (singular values)",
      brief(excitation.rotation(0) / kDegree) + ", " + brief(excitation.rotation(1) / kDegree) + ", " +
          brief(excitation.rotation(2) / kDegree) + " deg/s rms");
  row("correlation of the turning rates", brief(excitation.rotation_correlation));
  row("acceleration of the drone itself", brief(excitation.acceleration) + " m/s&sup2; rms");
  row("sigma of R_CI along its principal directions",
      brief(excitation.rotation_sigmas(0) / kDegree) + ", " + brief(excitation.rotation_sigmas(1) / kDegree) +
          ", " + brief(excitation.rotation_sigmas(2) / kDegree) + " deg");
  row("stated deviations were scaled by (vision, IMU)",
      brief(result.vision_sigma_scale) + ", " + brief(result.imu_sigma_scale));
  row("reported deviations were scaled by (the scene's misfit, the halves' disagreement)",
      brief(result.misfit_sigma_scale) + ", " + brief(result.halves_sigma_scale));
  out << "</table>\n";
  return out.str();
}

std::string splitHalfTable(const CalibrationResult& result) {
  if (result.split_half.empty()) return "<p>A half is too short to be calibrated on its own.</p>\n";
  std::ostringstream out;
  out << "<table><tr><th>parameter</th><th>difference</th><th>its "
         "sigma</th><th>unit</th><th>ratio</th></tr>\n";
  for (const auto& entry : result.split_half) {
    out << "<tr><td>" << entry.name << "</td><td>" << brief(entry.difference) << "</td><td>"
        << brief(entry.sigma) << "</td><td>" << entry.unit << "</td><td>" << brief(entry.ratio())
        << "</td></tr>\n";
  }
  out << "</table>\n";
  return out.str();
}

std::string ratePlots(const Diagnostics& diagnostics) {
  const HandEye& solution = diagnostics.alignment.hand_eye;
  const char* axes[] = {"x", "y", "z"};
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> measured, predicted;
    for (const RatePair& pair : diagnostics.alignment.rates) {
      measured.push_back(pair.camera[axis] / kDegree);
      predicted.push_back((solution.R_CI * (pair.imu - solution.gyro_bias))[axis] / kDegree);
    }
    SvgPlot plot(std::string("Turning rate about the camera's ") + axes[axis], "s", "deg/s");
    plot.addLine("measured by vision", diagnostics.alignment.t_s, measured, kBefore);
    plot.addLine("predicted from the gyro", diagnostics.alignment.t_s, predicted, kAfter);
    text += plot.svg();
  }
  return text;
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

std::string shiftPlots(const CalibrationResult& result) {
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
  return coarse.svg() + fine.svg();
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

double quantile(const std::vector<Eigen::Vector2d>& points, double share) {
  if (points.empty()) return 1;
  std::vector<double> norms;
  norms.reserve(points.size());
  for (const Eigen::Vector2d& point : points) norms.push_back(point.norm());
  const auto place = norms.begin() + static_cast<ptrdiff_t>(share * static_cast<double>(norms.size() - 1));
  std::nth_element(norms.begin(), place, norms.end());
  return std::max(*place, 1e-3);
}

std::string scatterPlots(const Diagnostics& diagnostics) {
  const double reach = 1.3 * std::max(quantile(diagnostics.scatter_before_px, 0.9),
                                      quantile(diagnostics.scatter_after_px, 0.9));
  std::string text;
  const auto add = [&](const char* title, const std::vector<Eigen::Vector2d>& points, const char* colour) {
    SvgPlot plot(title, "px", "px");
    plot.addPoints("", points, colour);
    plot.makeSquare(-reach, reach);
    text += plot.svg();
  };
  add("Ground points before", diagnostics.scatter_before_px, kBefore);
  add("Ground points after", diagnostics.scatter_after_px, kAfter);
  return text;
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
    t.push_back(static_cast<double>(sample.utime - input.frames.front()) * 1e-6);
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
  std::ostringstream out;
  out << "<!DOCTYPE html>\n<html><head><meta charset=\"utf-8\"><title>Calibration of " << subject.vehicle
      << "</title><style>" << kStyle << "</style></head><body>\n<h1>Calibration of " << subject.vehicle
      << "</h1>\n<p>From " << subject.source << "</p>\n";
  for (const std::string& warning : result.warnings)
    out << "<p class=\"weak\">Warning: " << warning << "</p>\n";
  out << "<h2>Verdicts</h2>\n" << parameterTable(result);
  out << "<h2>The recording</h2>\n" << factsTable(result);
  out << "<h2>Halves against each other</h2>\n" << splitHalfTable(result);
  if (diagnostics.alignment.possible) {
    out << "<h2>Rotation</h2>\n" << ratePlots(diagnostics) << rateResidualPlot(input, diagnostics);
    out << "<h2>Time shift</h2>\n" << shiftPlots(result);
  }
  out << "<h2>Residuals before and after</h2>\n" << transferPlot(diagnostics, target);
  if (!target) out << scatterPlots(diagnostics) << "<h2>Height</h2>\n" << heightPlot(input, diagnostics);
  out << "<h2>Biases</h2>\n"
      << biasPlot("Gyro bias", "deg/s", diagnostics.bias_t_s, diagnostics.gyro_bias, 1 / kDegree)
      << biasPlot("Accelerometer bias", "m/s^2", diagnostics.bias_t_s, diagnostics.accel_bias, 1);
  out << "</body></html>\n";
  return out.str();
}

}  // namespace redbee
