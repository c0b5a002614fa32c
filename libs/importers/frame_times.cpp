#include "redbee/importers/frame_times.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <string_view>

#include "redbee/files/ffmpeg.hpp"
#include "redbee/importers/time_check.hpp"

namespace redbee {

FrameTimes::FrameTimes(const std::filesystem::path& file, const AVFormatContext& input,
                       const AVStream& stream, double fps)
    : stream_(&stream), fps_(fps), source_(Source::kPresentation), edit_list_(file, input, stream) {
  // A raw stream: ffmpeg found no time when it looked for the streams.
  if ((input.iformat->flags & AVFMT_NOTIMESTAMPS) != 0 || stream.start_time == AV_NOPTS_VALUE) {
    source_ = Source::kRate;
  } else if (std::string_view(input.iformat->name) == "avi") {
    // A chunk of an AVI has a place, which is its decoding time, and no presentation time. ffmpeg guesses one
    // where there are no B-frames.
    source_ = Source::kDecoding;
  }
}

void FrameTimes::onPacket(const AVPacket& packet) {
  if (source_ == Source::kDecoding && packet.dts != AV_NOPTS_VALUE) decoding_times_.push_back(packet.dts);
}

std::optional<int64_t> FrameTimes::timeOf(const AVFrame& frame) {
  const int64_t number = frames_++;
  switch (source_) {
    case Source::kRate:
      return std::llround(1e6 * static_cast<double>(number) / fps_);
    case Source::kDecoding: {
      // Packets are decoded in the order of their decoding times, and every one has a frame: the n-th frame
      // that is shown takes the n-th time.
      if (decoding_times_.empty()) return std::nullopt;
      const int64_t ticks = decoding_times_.front();
      decoding_times_.pop_front();
      return microseconds(ticks);
    }
    case Source::kPresentation:
      break;
  }
  if (frame.best_effort_timestamp == AV_NOPTS_VALUE) return std::nullopt;
  return microseconds(frame.best_effort_timestamp + edit_list_.shiftAt(frame.pkt_pos));
}

int64_t FrameTimes::microseconds(int64_t ticks) const {
  return av_rescale_q(ticks, stream_->time_base, AVRational{1, 1000000});
}

bool FrameLeaps::isOne(const std::filesystem::path& file, int64_t frame, int64_t last_utime, int64_t utime) {
  constexpr int64_t kHandful = 3;
  const double leap_s = 1e-6 * (static_cast<double>(utime) - static_cast<double>(last_utime));
  if (leap_s <= kClockWasSet_s) return false;
  if (count_++ == 0) first_ = fmt::format("by {:.0f} s at frame {}", leap_s, frame);
  if (count_ > kHandful)
    throw InputError(file, "times leap " + first_ + ": the clock was set during the recording; cut it there");
  line_ = fmt::format("the times of {} frame{} leap, the first {}: left out", count_, count_ == 1 ? "" : "s",
                      first_);
  return true;
}

}  // namespace redbee
