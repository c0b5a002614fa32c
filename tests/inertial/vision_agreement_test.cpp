#include "redbee/inertial/vision_agreement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "redbee/geometry/so3.hpp"
#include "tests/support/camera.hpp"

namespace redbee::test {
namespace {

constexpr double kRate_hz = 25;
constexpr double kNoise_rad = 2e-4;  // a tenth of a pixel at 500 px

/// rad/s, of a drone that turns about all axes.
Eigen::Vector3d turning(double t_s) {
  return {0.3 * std::sin(4.1 * t_s), 0.2 * std::sin(2.3 * t_s + 1), 0.25 * std::cos(3.2 * t_s)};
}
Eigen::Vector3d still(double) { return Eigen::Vector3d::Zero(); }

using RateOf = std::function<Eigen::Vector3d(double t_s)>;

/// Pairs of frames as a flight delivers them, one after the other.
class Flight {
 public:
  explicit Flight(VisionAgreement& agreement) : agreement_(agreement) {}

  /// Returns the number of pairs after which they agreed.
  int fly(double duration_s, const RateOf& vision, const RateOf& imu, double outlier_fraction = 0) {
    int agreed = 0;
    const int end = frame_ + static_cast<int>(std::lround(duration_s * kRate_hz));
    for (; frame_ < end; ++frame_) {
      ComparedRotation pair;
      pair.time_previous = timeOf(frame_);
      pair.time = timeOf(frame_ + 1);
      pair.R_ba = rotationOf(imu);
      Eigen::Vector3d noise =
          kNoise_rad * Eigen::Vector3d(normal_(random_), normal_(random_), normal_(random_));
      if (uniform_(random_) < outlier_fraction) noise *= 100;
      pair.difference.difference = logSO3(rotationOf(vision) * pair.R_ba.transpose()) + noise;
      pair.difference.covariance = kNoise_rad * kNoise_rad * Eigen::Matrix3d::Identity();
      agreement_.note(pair);
      agreed += agreement_.agrees() ? 1 : 0;
      most_contradicted_ = std::max(most_contradicted_, agreement_.contradicted());
    }
    return agreed;
  }
  double mostContradicted() const { return most_contradicted_; }

 private:
  static CameraTime timeOf(int frame) { return CameraTime(std::chrono::milliseconds(frame * 40)); }
  Eigen::Matrix3d rotationOf(const RateOf& rate) const {
    constexpr int kParts = 10;
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    for (int i = 0; i < kParts; ++i) {
      R = expSO3(rate((frame_ + (i + 0.5) / kParts) / kRate_hz) / kRate_hz / kParts) * R;
    }
    return R;
  }

  VisionAgreement& agreement_;
  int frame_ = 0;
  double most_contradicted_ = 0;
  std::mt19937 random_{1};
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
};

/// The IMU's rates where the camera's clock is ahead.
RateOf withCameraAhead(double offset_s) {
  return [=](double t_s) { return turning(t_s + offset_s); };
}

TEST(VisionAgreement, RoughCalibrationsAgree) {
  const Eigen::Matrix3d turned = expSO3(Eigen::Vector3d(1, -1, 1).normalized() * 2 * kDegree);
  const RateOf imu = [&](double t_s) { return Eigen::Vector3d(turned * turning(t_s - 0.01)); };
  VisionAgreement agreement;
  Flight flight(agreement);
  EXPECT_EQ(flight.fly(60, turning, imu), 1500);
  EXPECT_LT(flight.mostContradicted(), 0.5);
  EXPECT_EQ(agreement.message(), "");
}

TEST(VisionAgreement, OffsetClocksDisagreeAndAreMeasured) {
  for (const double offset_s : {0.06, -0.06, 0.1, -0.1, 0.5, -0.5, 0.9}) {
    VisionAgreement agreement;
    Flight flight(agreement);
    EXPECT_LT(flight.fly(8, turning, withCameraAhead(offset_s)), 100) << offset_s;
    EXPECT_FALSE(agreement.agrees()) << offset_s;
    ASSERT_TRUE(agreement.clockOffset().has_value()) << offset_s;
    EXPECT_NEAR(*agreement.clockOffset(), offset_s, 0.011);
  }
}

TEST(VisionAgreement, TheMessageNamesTheClock) {
  VisionAgreement agreement;
  Flight(agreement).fly(8, turning, withCameraAhead(0.5));
  EXPECT_EQ(agreement.message(), "IMU and camera disagree: the camera's clock is about 0.50 s ahead");
}

TEST(VisionAgreement, ABiasedGyroIsNoClock) {
  const RateOf imu = [](double t_s) { return Eigen::Vector3d(turning(t_s) + Eigen::Vector3d(0.1, 0, 0)); };
  VisionAgreement agreement;
  Flight(agreement).fly(8, turning, imu);
  EXPECT_FALSE(agreement.agrees());
  EXPECT_FALSE(agreement.clockOffset().has_value());
  EXPECT_EQ(agreement.message(), "IMU and camera disagree: rotations differ, clocks or mounting?");
}

TEST(VisionAgreement, AFifthOfOutliersIsNoDisagreement) {
  VisionAgreement agreement;
  Flight flight(agreement);
  EXPECT_EQ(flight.fly(60, turning, turning, 0.2), 1500);
}

TEST(VisionAgreement, TheyAgreeAgainAfterSecondsOfTurning) {
  VisionAgreement agreement;
  Flight flight(agreement);
  flight.fly(8, turning, withCameraAhead(0.1));
  ASSERT_FALSE(agreement.agrees());
  EXPECT_EQ(flight.fly(20, still, still), 0) << "a drone that does not turn shows no offset";
  EXPECT_EQ(flight.fly(1.9, turning, turning), 0);
  flight.fly(3, turning, turning);
  EXPECT_TRUE(agreement.agrees());
  EXPECT_EQ(agreement.message(), "");
  EXPECT_EQ(flight.fly(20, turning, turning), 500);
}

TEST(VisionAgreement, AFewAgreeingPairsAreNoAgreement) {
  const RateOf changing = [](double t_s) { return turning(std::fmod(t_s, 3) < 1.5 ? t_s : t_s - 0.2); };
  VisionAgreement agreement;
  Flight flight(agreement);
  flight.fly(8, turning, withCameraAhead(0.2));
  EXPECT_EQ(flight.fly(60, turning, changing), 0);
}

TEST(VisionAgreement, DamagedPairsAreIgnored) {
  VisionAgreement agreement;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ComparedRotation pair;
  pair.R_ba.setIdentity();
  pair.difference.covariance.setIdentity();
  for (int k = 0; k < 100; ++k) {
    pair.time_previous = CameraTime(std::chrono::milliseconds(40 * k));
    pair.time = CameraTime(std::chrono::milliseconds(40 * (k + 1)));
    pair.difference.difference.setConstant(nan);
    agreement.note(pair);
    std::swap(pair.time, pair.time_previous);
    pair.difference.difference.setConstant(100);
    agreement.note(pair);
  }
  EXPECT_TRUE(agreement.agrees());
  EXPECT_EQ(agreement.contradicted(), 0);
}

/// 5 m above the ground, looking 30 degrees down.
PlaneMotion flightStep() {
  PlaneMotion motion;
  motion.R_ba = expSO3(Eigen::Vector3d(0.01, -0.02, 0.005));
  motion.t_ba = {0.05, -0.02, -0.2};
  motion.m_a = Eigen::Vector3d(0, std::cos(30 * kDegree), std::sin(30 * kDegree));
  motion.h_a = 5;
  return motion;
}
Eigen::Matrix3d scaledCamera() {
  return ImageScaling(camera().ideal().width, camera().ideal().height).T * camera().K();
}

TEST(RotationDifference, IsTheRotationWhateverTheTranslation) {
  const PlaneMotion imu = flightStep();
  const Eigen::Vector3d difference(2e-4, -3e-4, 1e-4);
  PlaneMotion vision = imu;
  vision.R_ba = expSO3(difference) * imu.R_ba;
  vision.t_ba += Eigen::Vector3d(0.03, 0.02, -0.04);
  const Matrix8d covariance = 1e-8 * Matrix8d::Identity();
  const auto found = rotationDifference(scaledCamera(), imu, Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero(),
                                        toVector(planeHomography(scaledCamera(), vision)), covariance);
  ASSERT_TRUE(found.has_value());
  EXPECT_LT((found->difference - difference).norm(), 0.05 * difference.norm());
}

/// The squared normalized difference has three degrees of freedom: its mean over 1000 draws is 3 with a
/// standard deviation of sqrt(6 / 1000).
TEST(RotationDifference, ItsCovarianceIsThatOfItsError) {
  const PlaneMotion imu = flightStep();
  const double noise = 1e-4;
  const double imu_noise = 5e-5;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  double sum = 0;
  for (int i = 0; i < 1000; ++i) {
    PlaneMotion vision = imu;
    vision.R_ba =
        expSO3(imu_noise * Eigen::Vector3d(normal(random), normal(random), normal(random))) * imu.R_ba;
    Vector8d observed = toVector(planeHomography(scaledCamera(), vision));
    for (double& entry : observed) entry += noise * normal(random);
    const auto found =
        rotationDifference(scaledCamera(), imu, imu_noise * imu_noise * Eigen::Matrix3d::Identity(),
                           Eigen::Matrix3d::Zero(), observed, noise * noise * Matrix8d::Identity());
    ASSERT_TRUE(found.has_value());
    sum += found->difference.dot(found->covariance.inverse() * found->difference) / 1000;
  }
  EXPECT_NEAR(sum, 3, 4 * std::sqrt(6.0 / 1000));
}

TEST(RotationDifference, NeedsACovariance) {
  const Matrix8d none = -Matrix8d::Identity();
  EXPECT_FALSE(rotationDifference(scaledCamera(), flightStep(), Eigen::Matrix3d::Zero(),
                                  Eigen::Matrix3d::Zero(), Vector8d::Zero(), none)
                   .has_value());
}

}  // namespace
}  // namespace redbee::test
