// One filled message of every type, for tests of the codec.
#pragma once

#include <numeric>
#include <vector>

#include "redbee/altimeter_t.hpp"
#include "redbee/bus/codec.hpp"
#include "redbee/detection_t.hpp"
#include "redbee/filter_snapshot_t.hpp"
#include "redbee/inertial_homography_t.hpp"
#include "redbee/ins_t.hpp"

namespace redbee::test {

template <typename Number>
std::vector<Number> counted(size_t n, int start) {
  std::vector<Number> numbers(n);
  std::iota(numbers.begin(), numbers.end(), static_cast<Number>(start));
  return numbers;
}

template <typename Message>
void fillTracks(Message& message, int n) {
  message.n = n;
  message.x_previous = counted<float>(static_cast<size_t>(n), 1);
  message.y_previous = counted<float>(static_cast<size_t>(n), 100);
  message.x = counted<float>(static_cast<size_t>(n), 200);
  message.y = counted<float>(static_cast<size_t>(n), 300);
}

/// Values that differ from zero and from each other where it is cheap to make them so. `Message{}` zeroes all
/// else.
template <typename Message>
Message sample();

template <>
inline image_metadata_t sample() {
  image_metadata_t message{};
  message.key = "exposure";
  message.value = counted<uint8_t>(5, 7);
  message.n = 5;
  return message;
}

template <>
inline image_t sample() {
  image_t message{};
  message.utime = 1234567890123;
  message.width = 4;
  message.height = 3;
  message.row_stride = 4;
  message.data = counted<uint8_t>(12, 0);
  message.size = 12;
  message.metadata = {sample<image_metadata_t>(), sample<image_metadata_t>()};
  message.nmetadata = 2;
  return message;
}

template <>
inline ins_t sample() {
  ins_t message{};
  message.utime = -5;
  message.gyro[2] = 0.25;
  message.accel[0] = 9.81;
  message.rel_alt = 12;
  return message;
}

template <>
inline altimeter_t sample() {
  altimeter_t message{};
  message.utime = 77;
  message.height = 12.5;
  message.sigma = 0.05;
  return message;
}

template <>
inline detection_t sample() {
  detection_t message{};
  message.id = 42;
  message.score = 0.75;
  message.seen = 1;
  return message;
}

template <>
inline detections_t sample() {
  detections_t message{};
  message.utime = 99;
  message.detections = {sample<detection_t>(), sample<detection_t>(), sample<detection_t>()};
  message.n = 3;
  return message;
}

template <>
inline foreground_t sample() {
  foreground_t message{};
  message.utime = 99;
  message.probability = counted<uint8_t>(9, 3);
  message.probability_size = 9;
  message.mask = counted<uint8_t>(4, 30);
  message.mask_size = 4;
  return message;
}

template <>
inline inertial_homography_t sample() {
  inertial_homography_t message{};
  message.utime = 99;
  message.H[4] = 1.5;
  message.covariance[63] = 1e-6;
  message.feedback_test_ratio = 0.5;
  return message;
}

template <>
inline filter_snapshot_t sample() {
  filter_snapshot_t message{};
  message.utime = 99;
  message.configuration = "0123456789abcdef";
  message.height = 5.5;
  message.R_CI_sigma[2] = 1e-3;
  return message;
}

template <>
inline visual_homography_t sample() {
  visual_homography_t message{};
  message.utime = 99;
  message.H[8] = 1;
  message.rms = 0.25;
  fillTracks(message, 6);
  message.inlier = counted<uint8_t>(6, 0);
  return message;
}

template <>
inline fused_homography_t sample() {
  fused_homography_t message{};
  message.utime = 99;
  message.plane_distance = 11.5;
  fillTracks(message, 3);
  return message;
}

template <>
inline process_health_t sample() {
  process_health_t message{};
  message.process = "redbee-test";
  message.message = "no IMU";
  message.rate_in = 24;
  message.version = "1.2.3";
  message.configuration = "0123456789abcdef";
  return message;
}

}  // namespace redbee::test
