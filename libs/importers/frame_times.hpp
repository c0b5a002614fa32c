// The times of decoded frames, also where the container gives none.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>

#include "redbee/importers/edit_list.hpp"

struct AVFormatContext;
struct AVFrame;
struct AVPacket;
struct AVStream;

namespace redbee {

class FrameTimes {
 public:
  /// `fps`: Hz, of a stream without times; 0: not known.
  FrameTimes(const std::filesystem::path& file, const AVFormatContext& input, const AVStream& stream,
             double fps);

  /// True for a stream without times whose frame rate is not known.
  bool needsRate() const { return source_ == Source::kRate && !(fps_ > 0); }
  /// False where the container has times, so that a rate is of no use.
  bool usesRate() const { return source_ == Source::kRate; }
  /// To be called for each packet that the decoder takes.
  void onPacket(const AVPacket& packet);
  /// us. To be called for each frame, in the order of display.
  std::optional<int64_t> timeOf(const AVFrame& frame);
  /// The packets before are not going to give a frame.
  void restart() { decoding_times_.clear(); }

 private:
  enum class Source { kPresentation, kDecoding, kRate };
  int64_t microseconds(int64_t ticks) const;

  const AVStream* stream_;
  double fps_;
  Source source_;
  EditList edit_list_;
  std::deque<int64_t> decoding_times_;  ///< ticks
  int64_t frames_ = 0;
};

/// Frames whose times lie so far ahead that they cannot be true.
class FrameLeaps {
 public:
  /// `utime` of a frame that follows number `frame` - 1, which has `last_utime`. Throws InputError where
  /// there are more such than a handful: a clock was set.
  bool isOne(const std::filesystem::path& file, int64_t frame, int64_t last_utime, int64_t utime);
  /// For the summary; empty where there was none.
  const std::string& line() const { return line_; }

 private:
  int64_t count_ = 0;
  std::string first_;
  std::string line_;
};

}  // namespace redbee
