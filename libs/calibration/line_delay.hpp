// The line delay of a rolling shutter, from where points lie that one homography moves (libs/README.md,
// "Rolling shutter"). With the camera's motion at each frame known, a match's residuals are linear in the
// delay d:
//
//     x_b - H x_a = J_h dh + (D_H g_a - g_b) d        g: derivative of a point's place at the middle row's
//     time by d
//
// Each match has its own dh, which is eliminated.
#pragma once

#include <cmath>
#include <vector>

#include "redbee/calibration/calibration.hpp"
#include "redbee/calibration/joint_state.hpp"
#include "redbee/calibration/recording.hpp"

namespace redbee::calibration {

struct LineDelay {
  double delay_s = 0;  ///< from one row to the next
  /// The larger of that by the residuals of all points and that by the scatter of the matches' own estimates;
  /// infinity if nothing shows the delay.
  double sigma_s = 0;

  /// Whether a global shutter is out of the question.
  bool isSignificant() const { return std::abs(delay_s) > 3 * sigma_s; }
};

/// `recording`: over ground; `state`: its solution.
LineDelay estimateLineDelay(const Recording& recording, const JointState& state);

/// The input's points where a global shutter would have seen them. `recording`: of this input.
std::vector<GroundMatch> withoutLineDelay(const CalibrationInput& input, const Recording& recording,
                                          const JointState& state, double delay_s);

}  // namespace redbee::calibration
