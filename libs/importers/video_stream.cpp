#include "redbee/importers/video_stream.hpp"

#include <cmath>
#include <string>

#include "redbee/files/ffmpeg.hpp"
#include "redbee/files/input_error.hpp"

extern "C" {
#include <libavutil/display.h>
}

namespace redbee {
namespace {

/// A cover image or a thumbnail is no recording.
bool isRecording(const AVStream& stream) {
  return stream.codecpar->codec_type == AVMEDIA_TYPE_VIDEO &&
         (stream.disposition & (AV_DISPOSITION_ATTACHED_PIC | AV_DISPOSITION_TIMED_THUMBNAILS)) == 0;
}

}  // namespace

AVStream* findVideo(AVFormatContext& input) {
  AVStream* found = nullptr;
  const AVCodec* codec = nullptr;  // asked for: then only a stream that can be decoded is found
  const int best = av_find_best_stream(&input, AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
  if (best >= 0 && isRecording(*input.streams[best])) found = input.streams[best];
  for (unsigned i = 0; i < input.nb_streams; ++i) {
    if (found == nullptr && isRecording(*input.streams[i])) found = input.streams[i];
  }
  for (unsigned i = 0; i < input.nb_streams; ++i) {
    if (input.streams[i] != found) input.streams[i]->discard = AVDISCARD_ALL;
  }
  return found;
}

VideoChoice choiceOf(const AVFormatContext& input, const AVStream& taken) {
  VideoChoice choice;
  for (unsigned i = 0; i < input.nb_streams; ++i) {
    if (!isRecording(*input.streams[i])) continue;
    ++choice.of;
    if (input.streams[i] == &taken) choice.number = choice.of;
  }
  return choice;
}

int rotationOf(const std::filesystem::path& path, const AVStream& stream) {
  const auto* matrix =
      reinterpret_cast<const int32_t*>(av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr));
  if (matrix == nullptr) return 0;
  const double clockwise = -av_display_rotation_get(matrix);
  const double mirrored =
      static_cast<double>(matrix[0]) * matrix[4] - static_cast<double>(matrix[1]) * matrix[3];
  if (!std::isfinite(clockwise) || mirrored < 0)
    throw InputError(path, "states that its images are mirrored: no camera sees so");
  const double quarters = std::round(clockwise / 90);
  if (std::abs(clockwise - 90 * quarters) > 1) {
    throw InputError(path, "states a rotation by " + std::to_string(std::lround(clockwise)) +
                               " degrees: only quarter turns can be applied");
  }
  return static_cast<int>((static_cast<int64_t>(quarters) % 4 + 4) % 4) * 90;
}

double pixelAspectOf(const AVStream& stream) {
  constexpr double kLargest = 4;  // anamorphic lenses have 2
  const bool is_in_container = stream.sample_aspect_ratio.num > 0;
  const AVRational ratio =
      is_in_container ? stream.sample_aspect_ratio : stream.codecpar->sample_aspect_ratio;
  if (ratio.num <= 0 || ratio.den <= 0) return 1;
  const double aspect = av_q2d(ratio);
  return aspect >= 1 / kLargest && aspect <= kLargest ? aspect : 1;
}

}  // namespace redbee
