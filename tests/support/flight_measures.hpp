// How well the stack does on a simulated flight: its inertial and fused homographies and its masks, by exact
// truth.
#pragma once

#include <algorithm>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "redbee/evaluation/pixel_measures.hpp"
#include "tests/support/stack_run.hpp"

namespace redbee::test {

struct FlightMeasures {
  double error_at_half_recall = 0;
  double fused_px = 0;       ///< mean transfer error
  double inertial_px = 0;    ///< the same of the inertial homographies that were valid
  double inertial_part = 0;  ///< of the frames that had one
};

/// Runs it, and measures from frame `settled` on; prints a line that begins with `name`.
inline FlightMeasures measured(const std::string& name, const StackFlight& flight, int settled = 24) {
  const StackOutput output = StackRun(flight).run();
  FlightMeasures result;
  PixelMeasures measures;
  const int frames = static_cast<int>(flight.frame_utimes.size());
  int valid = 0;
  for (int k = settled; k < frames; ++k) {
    const auto index = static_cast<size_t>(k);
    const int64_t utime = flight.frame_utimes[index];
    const Eigen::Matrix3d& truth = flight.homographies[index];
    measures.add(cv::imdecode(output.foreground.at(utime).probability, cv::IMREAD_GRAYSCALE),
                 flight.masks[index]);
    result.fused_px += groundError(output.fused.at(utime), truth) / (frames - settled);
    const auto inertial = output.inertial.find(utime);
    if (inertial == output.inertial.end() || inertial->second.valid == 0) continue;
    ++valid;
    result.inertial_px += meanTransferError(Eigen::Map<const RowMajor3d>(inertial->second.ground.H), truth,
                                            inertial->second.width, inertial->second.height);
  }
  result.error_at_half_recall = measures.errorAtHalfRecall();
  result.inertial_px /= std::max(valid, 1);
  result.inertial_part = static_cast<double>(valid) / (frames - settled);
  std::cout << name << ": Error@50% " << result.error_at_half_recall << ", homography " << result.fused_px
            << " px, the inertial one " << result.inertial_px << " px in " << 100 * result.inertial_part
            << " % of the frames\n";
  return result;
}

}  // namespace redbee::test
