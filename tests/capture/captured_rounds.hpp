// What a stack made of a flight that was played several times, frame by frame of the log.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "redbee/bus/bus.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/evaluation/pixel_measures.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/image_t.hpp"
#include "redbee/process_health_t.hpp"
#include "redbee/results/run_folder.hpp"

namespace redbee::test {

struct SentFrame {
  int round = 0;
  int frame = -1;     ///< number in the log
  int64_t utime = 0;  ///< when it was exposed, on this computer's clock
};

struct RoundMeasures {
  int frames = 0;                    ///< sent
  int masks = 0;                     ///< of them, with a trusted mask
  PixelMeasures captured, replayed;  ///< over the frames with a trusted mask
};

class CapturedRounds {
 public:
  CapturedRounds(Bus& bus, std::vector<image_t> log) : log_(std::move(log)) {
    subscriptions_.push_back(bus.subscribe<image_t>("CAMERA", 64, [this](const image_t& m) { note(m); }));
    subscriptions_.push_back(bus.subscribe<foreground_t>(
        "FOREGROUND", 64, [this](const foreground_t& m) { foreground_[m.utime] = m; }));
    subscriptions_.push_back(
        bus.subscribe<process_health_t>("PROCESS_HEALTH", 256, [this](const process_health_t& m) {
          constexpr int8_t kDead = 4;
          if (m.state != kDead) pids_[m.process].insert(m.pid), newest_pid_[m.process] = m.pid;
        }));
  }

  /// The lines that the player has added.
  void readSent(const std::filesystem::path& file) {
    std::ifstream lines(file);
    lines.seekg(read_);
    for (std::string line; std::getline(lines, line) && !lines.eof();
         read_ += static_cast<int>(line.size()) + 1) {
      SentFrame sent;
      long long utime = 0;
      if (std::sscanf(line.c_str(), "%d,%d,%lld", &sent.round, &sent.frame, &utime) != 3) continue;
      sent.utime = utime;
      sent_.push_back(sent);
    }
  }
  SentFrame newest() const { return sent_.empty() ? SentFrame() : sent_.back(); }
  int newestPid(const std::string& program) const {
    const auto found = newest_pid_.find(program);
    return found == newest_pid_.end() ? 0 : found->second;
  }
  size_t lives(const std::string& program) const {
    const auto found = pids_.find(program);
    return found == pids_.end() ? 0 : found->second.size();
  }

  RoundMeasures measure(const std::vector<int>& rounds, const RunFolder& replay,
                        const std::filesystem::path& labels) const {
    const std::vector<std::filesystem::path> truth = sorted(labels);
    RoundMeasures m;
    for (const SentFrame& sent : sent_) {
      if (std::find(rounds.begin(), rounds.end(), sent.round) == rounds.end()) continue;
      ++m.frames;
      const foreground_t* result = resultOf(sent);
      const auto k = static_cast<size_t>(sent.frame);
      const int64_t utime = log_.at(k).utime;
      if (result == nullptr || !replay.has(RunMap::kProbability, utime)) continue;
      ++m.masks;
      const cv::Mat1b label = cv::imread(truth.at(k).string(), cv::IMREAD_GRAYSCALE);
      m.captured.add(cv::imdecode(result->probability, cv::IMREAD_GRAYSCALE), label);
      m.replayed.add(replay.read(RunMap::kProbability, utime), label);
    }
    return m;
  }

  int masksAfter(int round, int frame) const {
    return static_cast<int>(std::count_if(sent_.begin(), sent_.end(), [&](const SentFrame& sent) {
      return sent.round == round && sent.frame > frame && resultOf(sent) != nullptr;
    }));
  }

  /// By how much the camera's stamps are later than the exposures.
  void printTimes() const {
    std::vector<double> late_ms;
    for (const auto& [utime, image] : images_) {
      if (const SentFrame* sent = sentAt(utime))
        late_ms.push_back(1e-3 * static_cast<double>(utime - sent->utime));
    }
    if (late_ms.empty()) return;
    std::sort(late_ms.begin(), late_ms.end());
    const auto at = [&](double part) {
      return late_ms[static_cast<size_t>(part * static_cast<double>(late_ms.size() - 1))];
    };
    std::printf(
        "images: %zu of %zu sent; stamped after their exposure by %.2f ms (median), %.2f to %.2f (1 to 99 "
        "%%), at most %.2f\n",
        images_.size(), sent_.size(), at(0.5), at(0.01), at(0.99), at(1));
  }

  /// What RTP's compression cost.
  void printLoss() const {
    double squares = 0;
    int64_t pixels = 0;
    for (const auto& [utime, image] : images_) {
      const SentFrame* sent = sentAt(utime);
      if (sent == nullptr || sent->round > 0) continue;
      const auto captured = decodeGrey(image);
      const auto original = decodeGrey(log_.at(static_cast<size_t>(sent->frame)));
      if (!captured || !original || captured->size() != original->size()) continue;
      squares += cv::norm(*captured, *original, cv::NORM_L2SQR);
      pixels += static_cast<int64_t>(captured->total());
    }
    if (pixels > 0)
      std::printf("JPEG over RTP: %.1f dB to the recorded images\n",
                  10 * std::log10(255.0 * 255.0 * static_cast<double>(pixels) / std::max(squares, 1.0)));
  }

 private:
  static constexpr int64_t kMostLate_us = 30'000;  ///< less than a frame's distance
  static constexpr int64_t kMostEarly_us = 5'000;

  void note(const image_t& message) { images_[message.utime] = message; }

  /// The image that was sent at most so long before.
  const SentFrame* sentAt(int64_t utime) const {
    const auto after = std::upper_bound(sent_.begin(), sent_.end(), utime + kMostEarly_us,
                                        [](int64_t t, const SentFrame& sent) { return t < sent.utime; });
    if (after == sent_.begin()) return nullptr;
    const SentFrame& sent = *std::prev(after);
    return utime - sent.utime <= kMostLate_us ? &sent : nullptr;
  }

  /// nullptr without a trusted mask.
  const foreground_t* resultOf(const SentFrame& sent) const {
    for (auto it = foreground_.lower_bound(sent.utime - kMostEarly_us);
         it != foreground_.end() && it->first <= sent.utime + kMostLate_us; ++it) {
      if (it->second.status == foreground_t::GOOD && sentAt(it->first) == &sent) return &it->second;
    }
    return nullptr;
  }

  static std::vector<std::filesystem::path> sorted(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
  }

  std::vector<image_t> log_;
  std::vector<SentFrame> sent_;
  std::streamoff read_ = 0;
  std::map<int64_t, image_t> images_;
  std::map<int64_t, foreground_t> foreground_;
  std::map<std::string, std::set<int>> pids_;
  std::map<std::string, int> newest_pid_;
  std::vector<Subscription> subscriptions_;
};

}  // namespace redbee::test
