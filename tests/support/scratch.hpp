// Small flights made for a test, in a folder that is gone afterwards.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "redbee/files/input_error.hpp"
#include "redbee/files/log.hpp"

namespace redbee::testing {

namespace fs = std::filesystem;

class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "redbee-test-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  fs::path operator/(const std::string& name) const { return path_ / name; }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

inline void writeText(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string readText(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline std::vector<LogEvent> readEvents(const fs::path& path) {
  LogReader reader(path);
  std::vector<LogEvent> events;
  while (auto event = reader.next()) events.push_back(std::move(*event));
  EXPECT_EQ(reader.damaged(), 0) << reader.complaint();
  EXPECT_FALSE(reader.truncated()) << reader.complaint();
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

/// The one line that the work complains with; empty where it does not.
inline std::string complaintOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline bool isSortedByTime(const std::vector<LogEvent>& events) {
  return std::is_sorted(events.begin(), events.end(),
                        [](const LogEvent& a, const LogEvent& b) { return a.utime < b.utime; });
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

/// Recorded flights outside the repository; nothing where there are none.
inline std::optional<fs::path> recordedFlight(const std::string& name) {
  const char* folder = std::getenv("REDBEE_SHARED");
  const fs::path shared =
      folder != nullptr ? fs::path(folder) : fs::path(REDBEE_SOURCE_DIR) / ".." / "shared";
  const fs::path flight = shared / "flights" / name;
  return fs::exists(flight) ? std::optional<fs::path>(flight) : std::nullopt;
}

}  // namespace redbee::testing
