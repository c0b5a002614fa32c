#include "redbee/importers/video_reader.hpp"

#include <algorithm>
#include <cmath>

#include "redbee/files/ffmpeg.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"

namespace redbee {
namespace {

constexpr AVRational kMicroseconds{1, 1000000};

ffmpeg::Input openInput(const std::filesystem::path& path) {
  ffmpeg::silence();
  requireFile(path);
  AVFormatContext* raw = nullptr;
  const int opened = avformat_open_input(&raw, path.c_str(), nullptr, nullptr);
  if (opened < 0) throw InputError(path, "is no video or is cut short: " + ffmpeg::explain(opened));
  ffmpeg::Input input(raw);
  const int found = avformat_find_stream_info(input.get(), nullptr);
  if (found < 0) throw InputError(path, "its streams cannot be read: " + ffmpeg::explain(found));
  return input;
}

/// The size that keeps the aspect, both sides even so that every codec takes it.
cv::Size scaledSize(int width, int height, int wanted_width) {
  if (wanted_width <= 0 || wanted_width == width) return {width, height};
  const int even_width = std::max(2, wanted_width / 2 * 2);
  const int even_height =
      std::max(2, 2 * static_cast<int>(std::lround(static_cast<double>(height) * even_width / width / 2)));
  return {even_width, even_height};
}

}  // namespace

class VideoReader::Implementation {
 public:
  Implementation(const std::filesystem::path& path, const VideoReaderOptions& options)
      : path_(path),
        options_(options),
        input_(openInput(path)),
        packet_(av_packet_alloc()),
        frame_(av_frame_alloc()) {
    const AVCodec* codec = nullptr;
    const int index = av_find_best_stream(input_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
    if (index < 0 || codec == nullptr) throw InputError(path_, "has no video stream that can be decoded");
    stream_ = input_->streams[index];
    for (unsigned i = 0; i < input_->nb_streams; ++i) {
      if (static_cast<int>(i) != index) input_->streams[i]->discard = AVDISCARD_ALL;
    }
    decoder_.reset(avcodec_alloc_context3(codec));
    avcodec_parameters_to_context(decoder_.get(), stream_->codecpar);
    decoder_->pkt_timebase = stream_->time_base;
    const int opened = avcodec_open2(decoder_.get(), codec, nullptr);
    if (opened < 0) throw InputError(path_, "its decoder cannot be opened: " + ffmpeg::explain(opened));
  }

  int64_t expectedFrames() const { return stream_->nb_frames; }

  std::optional<VideoFrame> next() {
    while (true) {
      const int received = avcodec_receive_frame(decoder_.get(), frame_.get());
      if (received == 0) return take();
      if (received == AVERROR_EOF) return finish();
      if (received != AVERROR(EAGAIN)) failAfterLast("cannot be decoded: " + ffmpeg::explain(received));
      feed();
    }
  }

 private:
  [[noreturn]] void failAfterLast(const std::string& what) const {
    if (frames_ == 0) throw InputError(path_, "first frame " + what);
    throw InputError(path_, "is damaged or cut short: what follows frame " + std::to_string(frames_ - 1) +
                                " (" + std::to_string(static_cast<double>(last_utime_) / 1e6) +
                                " s), the last good one, " + what);
  }

  void feed() {
    while (true) {
      const int read = av_read_frame(input_.get(), packet_.get());
      if (read == AVERROR_EOF) return drain(missingPackets());
      if (read < 0) return drain("cannot be read: " + ffmpeg::explain(read));
      const bool ours = packet_->stream_index == stream_->index;
      const bool corrupt = (packet_->flags & AV_PKT_FLAG_CORRUPT) != 0;
      const int sent = ours && !corrupt ? avcodec_send_packet(decoder_.get(), packet_.get()) : 0;
      av_packet_unref(packet_.get());
      if (!ours) continue;
      if (corrupt) return drain("is cut short");
      if (sent < 0) return drain("cannot be decoded: " + ffmpeg::explain(sent));
      ++packets_;
      return;
    }
  }

  /// The decoder still holds frames: they are returned first, the error (if any) after the last good one.
  void drain(const std::string& complaint) {
    complaint_ = complaint;
    avcodec_send_packet(decoder_.get(), nullptr);
  }

  /// Containers with an index (MP4) state the number of packets; they end silently where the file does.
  std::string missingPackets() const {
    const bool indexed = stream_->nb_frames > 0;
    const int expected = indexed ? avformat_index_get_entries_count(stream_) : 0;
    if (packets_ >= expected) return "";
    return "is missing (" + std::to_string(expected - packets_) + " of " + std::to_string(expected) +
           " frames)";
  }

  std::optional<VideoFrame> finish() const {
    if (!complaint_.empty()) failAfterLast(complaint_);
    if (frames_ == 0) throw InputError(path_, "holds no frames");
    return std::nullopt;
  }

  std::optional<VideoFrame> take() {
    if (frame_->best_effort_timestamp == AV_NOPTS_VALUE) failAfterLast("has no presentation time");
    VideoFrame out;
    out.utime = av_rescale_q(frame_->best_effort_timestamp, stream_->time_base, kMicroseconds);
    if (frames_ > 0 && out.utime <= last_utime_) {
      throw InputError(path_, "time runs backwards or repeats at frame " + std::to_string(frames_) + ": " +
                                  std::to_string(out.utime) + " us after " + std::to_string(last_utime_) +
                                  " us");
    }
    out.image = convert();
    last_utime_ = out.utime;
    ++frames_;
    av_frame_unref(frame_.get());
    return out;
  }

  cv::Mat convert() {
    const auto format = static_cast<AVPixelFormat>(frame_->format);
    if (frame_->width != size_.width || frame_->height != size_.height) {
      if (!size_.empty()) failAfterLast("has another resolution");
      size_ = {frame_->width, frame_->height};
    }
    const cv::Size out_size = scaledSize(frame_->width, frame_->height, options_.width);
    const AVPixelFormat out_format = options_.grey ? AV_PIX_FMT_GRAY8 : AV_PIX_FMT_BGR24;
    if (!scaler_ || format != scaler_format_) {
      const int method = out_size == size_ ? SWS_BICUBIC : SWS_AREA;
      scaler_.reset(sws_getContext(frame_->width, frame_->height, format, out_size.width, out_size.height,
                                   out_format, method | SWS_ACCURATE_RND, nullptr, nullptr, nullptr));
      scaler_format_ = format;
      if (!scaler_) throw InputError(path_, "its pixel format cannot be converted");
    }
    cv::Mat image(out_size, options_.grey ? CV_8UC1 : CV_8UC3);
    uint8_t* planes[4] = {image.data, nullptr, nullptr, nullptr};
    const int strides[4] = {static_cast<int>(image.step), 0, 0, 0};
    sws_scale(scaler_.get(), frame_->data, frame_->linesize, 0, frame_->height, planes, strides);
    return image;
  }

  std::filesystem::path path_;
  VideoReaderOptions options_;
  ffmpeg::Input input_;
  ffmpeg::CodecContext decoder_;
  ffmpeg::Scaler scaler_;
  AVPixelFormat scaler_format_ = AV_PIX_FMT_NONE;
  ffmpeg::Packet packet_;
  ffmpeg::Frame frame_;
  AVStream* stream_ = nullptr;
  cv::Size size_;
  std::string complaint_;
  int64_t frames_ = 0;
  int64_t packets_ = 0;
  int64_t last_utime_ = 0;
};

VideoReader::VideoReader(const std::filesystem::path& path, const VideoReaderOptions& options)
    : implementation_(std::make_unique<Implementation>(path, options)) {}
VideoReader::~VideoReader() = default;
std::optional<VideoFrame> VideoReader::next() { return implementation_->next(); }
int64_t VideoReader::expectedFrames() const { return implementation_->expectedFrames(); }

std::vector<DataPacket> readDataTrack(const std::filesystem::path& path, const std::string& tag) {
  const ffmpeg::Input input = openInput(path);
  const AVStream* track = nullptr;
  for (unsigned i = 0; i < input->nb_streams; ++i) {
    AVStream* stream = input->streams[i];
    const uint32_t wanted = MKTAG(tag.at(0), tag.at(1), tag.at(2), tag.at(3));
    const bool matches = stream->codecpar->codec_tag == wanted && track == nullptr;
    if (matches) track = stream;
    stream->discard = matches ? AVDISCARD_DEFAULT : AVDISCARD_ALL;
  }
  std::vector<DataPacket> packets;
  if (track == nullptr) return packets;
  const ffmpeg::Packet packet(av_packet_alloc());
  int read = 0;
  for (; (read = av_read_frame(input.get(), packet.get())) >= 0; av_packet_unref(packet.get())) {
    if (packet->stream_index != track->index) continue;
    DataPacket out;
    out.start_s = static_cast<double>(packet->pts) * av_q2d(track->time_base);
    out.duration_s = static_cast<double>(packet->duration) * av_q2d(track->time_base);
    out.bytes.assign(packet->data, packet->data + packet->size);
    packets.push_back(std::move(out));
  }
  if (read != AVERROR_EOF) {
    throw InputError(path, "its '" + tag + "' track is cut short after packet " +
                               std::to_string(packets.size()) + ": " + ffmpeg::explain(read));
  }
  return packets;
}

}  // namespace redbee
