#include "redbee/results/video_writer.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

#include "redbee/files/ffmpeg.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/new_file.hpp"

extern "C" {
#include <libavutil/opt.h>
}

namespace redbee {

namespace {

/// Whole frames at all usual rates; more than 65535 is too fine for MPEG-4.
constexpr int kTicksPerSecond = 60000;

}  // namespace

class VideoWriter::Implementation {
 public:
  Implementation(const std::filesystem::path& path, const cv::Size& size, double fps, int quality)
      : file_(path), size_(size), fps_(fps), packet_(av_packet_alloc()), frame_(av_frame_alloc()) {
    if (size.width <= 0 || size.height <= 0 || size.width % 2 != 0 || size.height % 2 != 0) {
      throw std::invalid_argument("VideoWriter: width and height must be even and positive");
    }
    if (!(fps > 0)) throw std::invalid_argument("VideoWriter: fps must be positive");
    ffmpeg::silence();
    AVFormatContext* raw = nullptr;
    check(avformat_alloc_output_context2(&raw, nullptr, "mp4", file_.descriptorPath().c_str()));
    output_.reset(raw);
    openEncoder(quality);
    openFile();
    allocateFrame();
  }

  void write(const cv::Mat& image) { write(image, static_cast<double>(frames_) / fps_); }

  void write(const cv::Mat& image, double time_s) {
    if (image.size() != size_ || (image.type() != CV_8UC1 && image.type() != CV_8UC3)) {
      throw std::invalid_argument("VideoWriter: an image of another size or type");
    }
    check(av_frame_make_writable(frame_.get()));
    const AVPixelFormat format = image.channels() == 1 ? AV_PIX_FMT_GRAY8 : AV_PIX_FMT_BGR24;
    if (!scaler_ || format != format_) {
      scaler_.reset(sws_getContext(size_.width, size_.height, format, size_.width, size_.height,
                                   AV_PIX_FMT_YUV420P, SWS_BICUBIC, nullptr, nullptr, nullptr));
      format_ = format;
    }
    const uint8_t* planes[4] = {image.data, nullptr, nullptr, nullptr};
    const int strides[4] = {static_cast<int>(image.step), 0, 0, 0};
    sws_scale(scaler_.get(), planes, strides, 0, size_.height, frame_->data, frame_->linesize);
    const int64_t ticks = std::llround(time_s * kTicksPerSecond);
    if (frames_++ > 0 && ticks <= frame_->pts)
      throw std::invalid_argument("VideoWriter: a frame that is not later than the one before it");
    frame_->pts = ticks;
    encode(frame_.get());
  }

  void close() {
    if (!file_.isOpen()) return;
    encode(nullptr);
    check(av_write_trailer(output_.get()));
    check(avio_closep(&output_->pb));
    output_.reset();
    file_.commit();
  }

 private:
  void check(int result) const {
    if (result < 0) throw InputError(file_.path(), "cannot be written: " + ffmpeg::explain(result));
  }

  void openEncoder(int quality) {
    // Hardware encoders are listed even where there is no such hardware: opening is the test.
    const std::array<const AVCodec*, 3> candidates = {avcodec_find_encoder_by_name("libx264"),
                                                      avcodec_find_encoder(AV_CODEC_ID_H264),
                                                      avcodec_find_encoder(AV_CODEC_ID_MPEG4)};
    for (const AVCodec* codec : candidates) {
      if (codec == nullptr) continue;
      encoder_.reset(avcodec_alloc_context3(codec));
      encoder_->width = size_.width;
      encoder_->height = size_.height;
      encoder_->pix_fmt = AV_PIX_FMT_YUV420P;
      encoder_->time_base = {1, kTicksPerSecond};
      encoder_->framerate = av_d2q(fps_, 1001000);
      encoder_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
      encoder_->bit_rate = codec->id == AV_CODEC_ID_MPEG4 ? 4'000'000 : 0;
      // Other encoders have no such options, and do without.
      av_opt_set(encoder_->priv_data, "preset", "veryfast", 0);
      av_opt_set_double(encoder_->priv_data, "crf", quality, 0);
      if (avcodec_open2(encoder_.get(), codec, nullptr) == 0) return;
    }
    throw InputError(file_.path(), "cannot be written: ffmpeg has neither an H.264 nor an MPEG-4 encoder");
  }

  void openFile() {
    stream_ = avformat_new_stream(output_.get(), nullptr);
    check(avcodec_parameters_from_context(stream_->codecpar, encoder_.get()));
    stream_->time_base = encoder_->time_base;
    stream_->avg_frame_rate = encoder_->framerate;
    check(avio_open(&output_->pb, file_.descriptorPath().c_str(), AVIO_FLAG_WRITE));
    AVDictionary* options = nullptr;
    // The index at the front: a browser starts to play before it has everything.
    av_dict_set(&options, "movflags", "+faststart", 0);
    const int written = avformat_write_header(output_.get(), &options);
    av_dict_free(&options);
    check(written);
  }

  void allocateFrame() {
    frame_->format = AV_PIX_FMT_YUV420P;
    frame_->width = size_.width;
    frame_->height = size_.height;
    check(av_frame_get_buffer(frame_.get(), 0));
  }

  void encode(const AVFrame* frame) {
    check(avcodec_send_frame(encoder_.get(), frame));
    while (true) {
      const int received = avcodec_receive_packet(encoder_.get(), packet_.get());
      if (received == AVERROR(EAGAIN) || received == AVERROR_EOF) return;
      check(received);
      av_packet_rescale_ts(packet_.get(), encoder_->time_base, stream_->time_base);
      if (packet_->duration == 0)
        packet_->duration = av_rescale_q(1, av_inv_q(encoder_->framerate), stream_->time_base);
      packet_->stream_index = stream_->index;
      check(av_interleaved_write_frame(output_.get(), packet_.get()));
    }
  }

  PartialFile file_;  ///< outlives what writes to it
  cv::Size size_;
  double fps_;
  ffmpeg::Output output_;
  ffmpeg::CodecContext encoder_;
  ffmpeg::Scaler scaler_;
  AVPixelFormat format_ = AV_PIX_FMT_NONE;
  ffmpeg::Packet packet_;
  ffmpeg::Frame frame_;
  AVStream* stream_ = nullptr;
  int64_t frames_ = 0;
};

VideoWriter::VideoWriter(const std::filesystem::path& path, const cv::Size& size, double fps, int quality)
    : implementation_(std::make_unique<Implementation>(path, size, fps, quality)) {}
VideoWriter::~VideoWriter() = default;
void VideoWriter::write(const cv::Mat& image) { implementation_->write(image); }
void VideoWriter::write(const cv::Mat& image, double time_s) { implementation_->write(image, time_s); }
void VideoWriter::close() { implementation_->close(); }

}  // namespace redbee
