#include "redbee/inertial/calibration_monitor.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace redbee {
namespace {

TEST(CalibrationMonitor, TheCalibrationFitsWhileInnovationsStaySmall) {
  CalibrationMonitor monitor;
  for (int i = 0; i < 47; ++i) monitor.note(0.3, 0.2);
  EXPECT_EQ(monitor.status(), "unknown");
  monitor.note(0.3, 0.2);
  EXPECT_EQ(monitor.status(), "fits");
}

TEST(CalibrationMonitor, ReportsByHowMuchPredictionsAreOffForSeconds) {
  CalibrationMonitor monitor;
  for (int i = 0; i < 100; ++i) monitor.note(0.3, 0.2);
  for (int i = 0; i < 300; ++i) monitor.note(4.0, 3.1);
  EXPECT_EQ(monitor.status(), "does not fit: predicted homography off by 3 px");
  for (int i = 0; i < 600; ++i) monitor.note(0.3, 0.2);
  EXPECT_EQ(monitor.status(), "fits");
}

TEST(CalibrationMonitor, AFewBadFramesOrNumbersDoNotCount) {
  CalibrationMonitor monitor;
  for (int i = 0; i < 100; ++i) monitor.note(0.3, 0.2);
  for (int i = 0; i < 3; ++i) monitor.note(1e6, 50);
  monitor.note(std::numeric_limits<double>::quiet_NaN(), 1);
  monitor.note(1, std::numeric_limits<double>::infinity());
  EXPECT_EQ(monitor.status(), "fits");
}

}  // namespace
}  // namespace redbee
