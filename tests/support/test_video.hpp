// Videos as other programs write them: any container and codec, B-frames, rotation, damage, a GoPro's motion
// track.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "redbee/files/ffmpeg.hpp"
#include "redbee/importers/data_track.hpp"

extern "C" {
#include <libavutil/display.h>
#include <libavutil/opt.h>
}

namespace redbee::test {

struct TestVideo {
  std::string container = "mp4";
  std::string encoder = "libx264";
  int frames = 30;
  int fps = 25;
  int key_every = 250;
  int b_frames = 0;
  bool interlaced = false;
  bool twice = false;  ///< as two video streams
  AVRational pixel_aspect{1, 1};
  int rotation_deg = 0;      ///< that the container states, clockwise
  int broken_packet = -1;    ///< whose content is overwritten
  int late_frames = 0;       ///< at the end, by a day and a half
  double start_s = 0;        ///< of the first frame: what lies before 0 is cut by an edit list
  double track_start_s = 0;  ///< of the motion track: what lies before 0 is cut by an edit list
  std::vector<DataPacket> track;
  std::vector<uint8_t> cover;               ///< a PNG of 192x192 px
  std::function<cv::Mat(int frame)> image;  ///< grey
};

class TestVideoWriter {
 public:
  TestVideoWriter(const std::filesystem::path& path, const TestVideo& video) : video_(video) {
    ffmpeg::silence();
    AVFormatContext* raw = nullptr;
    require(avformat_alloc_output_context2(&raw, nullptr, video.container.c_str(), path.c_str()));
    output_.reset(raw);
    output_->avoid_negative_ts = AVFMT_AVOID_NEG_TS_DISABLED;
    openEncoder(video.image(0).size());
    if (video.twice) {
      second_ = avformat_new_stream(output_.get(), nullptr);
      require(avcodec_parameters_copy(second_->codecpar, stream_->codecpar));
      second_->time_base = stream_->time_base;
    }
    if (!video.track.empty()) addTrack();
    if (!video.cover.empty()) addCover();
    if ((output_->oformat->flags & AVFMT_NOFILE) == 0)
      require(avio_open(&output_->pb, path.c_str(), AVIO_FLAG_WRITE));
    require(avformat_write_header(output_.get(), nullptr));
  }

  void write() {
    if (cover_ != nullptr) writeCover();
    for (const DataPacket& packet : video_.track) writeTrack(packet);
    for (int k = 0; k < video_.frames; ++k) {
      const cv::Mat grey = video_.image(k);
      require(av_frame_make_writable(frame_.get()));
      for (int y = 0; y < grey.rows; ++y)
        std::memcpy(frame_->data[0] + y * frame_->linesize[0], grey.ptr(y), static_cast<size_t>(grey.cols));
      for (int plane : {1, 2})
        std::memset(frame_->data[plane], 128, static_cast<size_t>(frame_->linesize[plane] * grey.rows / 2));
      frame_->pts = k + (k >= video_.frames - video_.late_frames ? int64_t{129'600} * video_.fps : 0);
      frame_->interlaced_frame = video_.interlaced ? 1 : 0;
      encode(frame_.get());
    }
    encode(nullptr);
    require(av_write_trailer(output_.get()));
  }

 private:
  static void require(int result) { ASSERT_GE(result, 0) << ffmpeg::explain(result); }

  void openEncoder(cv::Size size) {
    const AVCodec* codec = avcodec_find_encoder_by_name(video_.encoder.c_str());
    ASSERT_NE(codec, nullptr) << video_.encoder;
    encoder_.reset(avcodec_alloc_context3(codec));
    encoder_->width = size.width;
    encoder_->height = size.height;
    encoder_->pix_fmt = AV_PIX_FMT_YUV420P;
    encoder_->time_base = {1, video_.fps};
    encoder_->framerate = {video_.fps, 1};
    encoder_->sample_aspect_ratio = video_.pixel_aspect;
    encoder_->gop_size = video_.key_every;
    encoder_->max_b_frames = video_.b_frames;
    encoder_->bit_rate = 2'000'000;
    if ((output_->oformat->flags & AVFMT_GLOBALHEADER) != 0) encoder_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    if (video_.interlaced) encoder_->flags |= AV_CODEC_FLAG_INTERLACED_DCT | AV_CODEC_FLAG_INTERLACED_ME;
    av_opt_set(encoder_->priv_data, "crf", "12", 0);
    av_opt_set(encoder_->priv_data, "sc_threshold", "0", 0);  // key frames only where `key_every` wants them
    require(avcodec_open2(encoder_.get(), codec, nullptr));
    stream_ = avformat_new_stream(output_.get(), nullptr);
    require(avcodec_parameters_from_context(stream_->codecpar, encoder_.get()));
    stream_->time_base = encoder_->time_base;
    stream_->sample_aspect_ratio = video_.pixel_aspect;
    if (video_.rotation_deg != 0) {
      auto* matrix =
          reinterpret_cast<int32_t*>(av_stream_new_side_data(stream_, AV_PKT_DATA_DISPLAYMATRIX, 36));
      av_display_rotation_set(matrix, video_.rotation_deg);
    }
    frame_->format = AV_PIX_FMT_YUV420P;
    frame_->width = size.width;
    frame_->height = size.height;
    require(av_frame_get_buffer(frame_.get(), 0));
  }

  void addTrack() {
    track_ = avformat_new_stream(output_.get(), nullptr);
    track_->codecpar->codec_type = AVMEDIA_TYPE_DATA;
    track_->codecpar->codec_id = AV_CODEC_ID_BIN_DATA;
    track_->codecpar->codec_tag = MKTAG('g', 'p', 'm', 'd');
    track_->time_base = {1, 1000};
  }

  void addCover() {
    cover_ = avformat_new_stream(output_.get(), nullptr);
    cover_->codecpar->codec_type = AVMEDIA_TYPE_VIDEO;
    cover_->codecpar->codec_id = AV_CODEC_ID_PNG;
    cover_->codecpar->width = cover_->codecpar->height = 192;
    cover_->disposition = AV_DISPOSITION_ATTACHED_PIC;
  }

  void writeCover() {
    require(av_new_packet(packet_.get(), static_cast<int>(video_.cover.size())));
    std::memcpy(packet_->data, video_.cover.data(), video_.cover.size());
    packet_->stream_index = cover_->index;
    packet_->flags |= AV_PKT_FLAG_KEY;
    require(av_interleaved_write_frame(output_.get(), packet_.get()));
  }

  void writeTrack(const DataPacket& data) {
    require(av_new_packet(packet_.get(), static_cast<int>(data.bytes.size())));
    std::memcpy(packet_->data, data.bytes.data(), data.bytes.size());
    const auto ticks = [&](double s) {
      return av_rescale_q(static_cast<int64_t>(1e6 * s), {1, 1000000}, track_->time_base);
    };
    packet_->pts = packet_->dts = ticks(video_.track_start_s + data.start_s);
    packet_->duration = ticks(data.duration_s);
    packet_->stream_index = track_->index;
    packet_->flags |= AV_PKT_FLAG_KEY;
    require(av_interleaved_write_frame(output_.get(), packet_.get()));
  }

  void encode(const AVFrame* frame) {
    require(avcodec_send_frame(encoder_.get(), frame));
    while (avcodec_receive_packet(encoder_.get(), packet_.get()) == 0) {
      if (packets_++ == video_.broken_packet)
        std::memset(packet_->data + 4, 0xFF, static_cast<size_t>(packet_->size - 4));
      if (packet_->duration == 0) packet_->duration = 1;
      av_packet_rescale_ts(packet_.get(), encoder_->time_base, stream_->time_base);
      const int64_t start = std::llround(video_.start_s / av_q2d(stream_->time_base));
      packet_->pts += start;
      packet_->dts += start;
      packet_->stream_index = stream_->index;
      if (second_ != nullptr) {
        const ffmpeg::Packet copy(av_packet_clone(packet_.get()));
        copy->stream_index = second_->index;
        require(av_interleaved_write_frame(output_.get(), copy.get()));
      }
      require(av_interleaved_write_frame(output_.get(), packet_.get()));
    }
  }

  TestVideo video_;
  ffmpeg::Output output_;
  ffmpeg::CodecContext encoder_;
  ffmpeg::Packet packet_{av_packet_alloc()};
  ffmpeg::Frame frame_{av_frame_alloc()};
  AVStream* stream_ = nullptr;
  AVStream* second_ = nullptr;
  AVStream* track_ = nullptr;
  AVStream* cover_ = nullptr;
  int packets_ = 0;
};

inline void writeTestVideo(const std::filesystem::path& path, const TestVideo& video) {
  TestVideoWriter(path, video).write();
}

/// An image that shows its number: a bright block in one of 64 places of an 8x8 board of 96x64 px.
inline cv::Mat numbered(int k) {
  cv::Mat image(64, 96, CV_8UC1, cv::Scalar(60));
  image(cv::Rect(12 * (k % 8), 8 * (k / 8 % 8), 12, 8)).setTo(220);
  return image;
}

/// The number that the image shows; -1 if it shows none.
inline int numberShownIn(const cv::Mat& image) {
  for (int k = 0; k < 64; ++k) {
    const cv::Scalar inside = cv::mean(image(cv::Rect(12 * (k % 8) + 2, 8 * (k / 8) + 2, 8, 4)));
    if (inside[0] > 160) return k;
  }
  return -1;
}

}  // namespace redbee::test
