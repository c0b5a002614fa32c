// RAII wrappers of ffmpeg's C types. Included by sources only, not by headers.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"
#include "redbee/files/mp4_tables.hpp"

namespace redbee::ffmpeg {

struct Deleter {
  void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(SwsContext* context) const { sws_freeContext(context); }
};
using CodecContext = std::unique_ptr<AVCodecContext, Deleter>;
using Frame = std::unique_ptr<AVFrame, Deleter>;
using Packet = std::unique_ptr<AVPacket, Deleter>;
using Scaler = std::unique_ptr<SwsContext, Deleter>;

struct InputCloser {
  void operator()(AVFormatContext* context) const { avformat_close_input(&context); }
};
using Input = std::unique_ptr<AVFormatContext, InputCloser>;

struct OutputCloser {
  void operator()(AVFormatContext* context) const {
    if (context->pb != nullptr) avio_closep(&context->pb);
    avformat_free_context(context);
  }
};
using Output = std::unique_ptr<AVFormatContext, OutputCloser>;

/// ffmpeg's message for an error code.
inline std::string explain(int error) {
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  return av_strerror(error, text, sizeof text) == 0 ? text : "error " + std::to_string(error);
}

/// Disables ffmpeg's own messages on stderr; errors are reported as exceptions.
inline void silence() { av_log_set_level(AV_LOG_QUIET); }

/// What openInput() reads: a header may not say all of the streams.
enum class Probe { kStreams, kHeaderOnly };

/// Opens a recording and finds its streams. `options`: of the demuxer. Throws InputError.
inline Input openInput(const std::filesystem::path& path,
                       const std::map<std::string, std::string>& options = {},
                       Probe probe = Probe::kStreams) {
  silence();
  requireFile(path);
  requirePossibleTables(path);
  AVDictionary* dictionary = nullptr;
  for (const auto& [key, value] : options) av_dict_set(&dictionary, key.c_str(), value.c_str(), 0);
  AVFormatContext* raw = nullptr;
  const int opened = avformat_open_input(&raw, path.c_str(), nullptr, &dictionary);
  av_dict_free(&dictionary);
  if (opened < 0) throw InputError(path, "is no video or is cut short: " + explain(opened));
  Input input(raw);
  if (probe == Probe::kHeaderOnly) return input;
  const int found = avformat_find_stream_info(input.get(), nullptr);
  if (found < 0) throw InputError(path, "its streams cannot be read: " + explain(found));
  return input;
}

}  // namespace redbee::ffmpeg
