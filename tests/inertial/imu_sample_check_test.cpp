#include "redbee/inertial/imu_sample_check.hpp"

#include <gtest/gtest.h>

#include <random>

namespace redbee {
namespace {

constexpr Duration kStep = std::chrono::milliseconds(5);  // 200 Hz

/// A gentle turn with consumer-grade noise.
std::vector<ImuSample> gentleFlight(int samples) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<ImuSample> flight;
  for (int i = 0; i < samples; ++i) {
    const double t = 0.005 * i;
    ImuSample s;
    s.time = ImuTime(std::chrono::seconds(1) + i * kStep);
    for (int axis = 0; axis < 3; ++axis) {
      s.gyro(axis) = 0.5 * std::sin(3 * t + axis) + 0.002 * normal(random);
      s.accel(axis) = 2 * std::cos(2 * t + axis) + 0.03 * normal(random);
    }
    s.accel.z() += 9.81;
    flight.push_back(s);
  }
  return flight;
}

std::vector<ImuSample> accepted(ImuSampleCheck& check, const std::vector<ImuSample>& samples) {
  std::vector<ImuSample> result;
  for (const ImuSample& sample : samples) {
    for (const ImuSample& good : check.filter(sample)) result.push_back(good);
  }
  return result;
}

constexpr ImuTime kEnd(std::chrono::seconds(10'000));

int refused(const ImuSampleCheck& check) { return check.refusedOn(ImuTime(), kEnd); }

TEST(ImuSampleCheck, AcceptsAFlightAndItsVibration) {
  ImuSampleCheck check({});
  std::vector<ImuSample> flight = gentleFlight(2000);
  for (size_t i = 1000; i < flight.size(); ++i) {  // motors on: 8 m/s^2 at half the sampling rate
    flight[i].accel.z() += i % 2 == 0 ? 8 : -8;
    flight[i].gyro.x() += i % 2 == 0 ? 0.4 : -0.4;
  }
  accepted(check, flight);
  EXPECT_LE(refused(check), 40) << "the first few of a vibration may be doubted";
  EXPECT_EQ(check.refusedOn(flight[1100].time, flight.back().time), 0);
}

TEST(ImuSampleCheck, RefusesASpikeAndKeepsItsNeighbours) {
  ImuSampleCheck check({});
  std::vector<ImuSample> flight = gentleFlight(100);
  flight[50].gyro.y() -= 8;
  flight[70].accel.x() += 40;
  const auto good = accepted(check, flight);
  EXPECT_EQ(good.size(), 98U);
  EXPECT_EQ(refused(check), 2);
  EXPECT_EQ(check.refusedOn(flight[49].time, flight[50].time), 1);
}

TEST(ImuSampleCheck, AcceptsAManoeuvre) {
  ImuSampleCheck check({});
  std::vector<ImuSample> flight = gentleFlight(100);
  for (size_t i = 50; i < 100; ++i) {
    flight[i].gyro.x() += std::min(6.0, 1.5 * static_cast<double>(i - 49));  // 300 rad/s^2
    flight[i].accel.z() += 20;                                               // a step
  }
  EXPECT_EQ(accepted(check, flight).size(), 100U);
  EXPECT_EQ(refused(check), 0);
}

TEST(ImuSampleCheck, RefusesSaturatedSamples) {
  ImuSampleCheck check({10, 80});
  std::vector<ImuSample> flight = gentleFlight(60);
  for (size_t i = 20; i < 30; ++i) flight[i].gyro.z() = -10;
  flight[40].accel.x() = 80;
  EXPECT_EQ(accepted(check, flight).size(), 49U);
  EXPECT_EQ(refused(check), 11);
}

TEST(ImuSampleCheck, RefusesOneStuckSensorUntilItMoves) {
  for (const bool gyro : {true, false}) {
    ImuSampleCheck check({});
    std::vector<ImuSample> flight = gentleFlight(300);
    for (size_t i = 101; i < 200; ++i) {
      if (gyro) flight[i].gyro = flight[100].gyro;
      if (!gyro) flight[i].accel = flight[100].accel;
    }
    accepted(check, flight);
    EXPECT_EQ(check.refusedOn(flight[111].time, flight[199].time), 88) << "from 50 ms on";
    EXPECT_EQ(check.refusedOn(flight[0].time, flight[109].time), 0);
    EXPECT_LE(check.refusedOn(flight[199].time, flight[299].time), 1);
  }
}

TEST(ImuSampleCheck, LateAndRepeatedSamplesPassButNoRefusedOne) {
  ImuSampleCheck check({});
  std::vector<ImuSample> flight = gentleFlight(20);
  std::swap(flight[5], flight[6]);
  flight[10].gyro.x() += 20;
  flight.insert(flight.begin() + 11, flight[10]);
  flight.insert(flight.begin() + 13, flight[10]);
  const auto good = accepted(check, flight);
  EXPECT_EQ(good.size(), 19U);
  for (const ImuSample& sample : good) EXPECT_LT(sample.gyro.norm(), 2);
}

TEST(ImuSampleCheck, RestartsWhereTimeIsSetBack) {
  ImuSampleCheck check({});
  std::vector<ImuSample> flight = gentleFlight(50);
  accepted(check, flight);
  for (ImuSample& sample : flight) sample.time -= std::chrono::hours(1);
  flight[30].accel.x() += 60;
  EXPECT_EQ(accepted(check, flight).size(), 49U);
}

TEST(ImuSampleCheck, RemembersABoundedNumber) {
  ImuSampleCheck check({1, 1});
  const std::vector<ImuSample> flight = gentleFlight(100);
  for (int round = 0; round < 200; ++round) accepted(check, flight);
  EXPECT_LE(refused(check), 8192);
  check.eraseBefore(kEnd);
  EXPECT_EQ(refused(check), 0);
}

}  // namespace
}  // namespace redbee
