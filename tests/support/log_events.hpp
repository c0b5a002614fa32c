// Content of LCM logs, error messages for bad input, and images for recordings.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "redbee/files/input_error.hpp"
#include "redbee/files/log.hpp"

namespace redbee::test {

inline std::vector<LogEvent> readEvents(const std::filesystem::path& path) {
  LogReader reader(path);
  std::vector<LogEvent> events;
  while (auto event = reader.next()) events.push_back(std::move(*event));
  EXPECT_EQ(reader.damaged(), 0) << reader.damageReport();
  EXPECT_FALSE(reader.truncated()) << reader.damageReport();
  return events;
}

template <typename Message>
Message decoded(const LogEvent& event) {
  Message message;
  EXPECT_GT(message.decode(event.data.data(), 0, static_cast<int>(event.data.size())), 0) << event.channel;
  return message;
}

template <typename Message>
std::vector<Message> messagesOn(const std::vector<LogEvent>& events, const std::string& channel) {
  std::vector<Message> messages;
  for (const LogEvent& event : events) {
    if (event.channel == channel) messages.push_back(decoded<Message>(event));
  }
  return messages;
}

inline bool isSortedByTime(const std::vector<LogEvent>& events) {
  return std::is_sorted(events.begin(), events.end(),
                        [](const LogEvent& a, const LogEvent& b) { return a.utime < b.utime; });
}

/// Message of the InputError that `work` throws, or empty.
inline std::string errorMessageOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// A textured image that moves with `index`.
inline cv::Mat texture(int width, int height, int index, int channels) {
  cv::Mat image(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at<uint8_t>(y, x) =
          static_cast<uint8_t>(128 + 60 * std::sin(0.3 * (x + 2 * index)) * std::cos(0.2 * y));
    }
  }
  if (channels == 3) cv::cvtColor(image, image, cv::COLOR_GRAY2BGR);
  return image;
}

}  // namespace redbee::test
