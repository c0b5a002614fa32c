#include "redbee/importers/video_reader.hpp"

#include "redbee/files/ffmpeg.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/importers/frame_converter.hpp"
#include "redbee/importers/frame_times.hpp"
#include "redbee/importers/video_stream.hpp"

namespace redbee {

class VideoReader::Implementation {
 public:
  Implementation(const std::filesystem::path& path, const VideoReaderOptions& options)
      : path_(path),
        options_(options),
        input_(ffmpeg::openInput(path)),
        stream_(findVideo(*input_)),
        packet_(av_packet_alloc()),
        frame_(av_frame_alloc()) {
    const AVCodec* codec = stream_ == nullptr ? nullptr : avcodec_find_decoder(stream_->codecpar->codec_id);
    if (codec == nullptr) throw InputError(path_, "has no video stream that can be decoded");
    rotation_deg_ = rotationOf(path_, *stream_);
    converter_ = std::make_unique<FrameConverter>(options.width, options.grey, rotation_deg_);
    times_ = std::make_unique<FrameTimes>(path, *input_, *stream_, options.fps);
    if (times_->needsRate())
      throw InputError(path_, "is a raw stream, which has no times: give its frame rate with --fps");
    decoder_.reset(avcodec_alloc_context3(codec));
    avcodec_parameters_to_context(decoder_.get(), stream_->codecpar);
    decoder_->pkt_timebase = stream_->time_base;
    const int opened = avcodec_open2(decoder_.get(), codec, nullptr);
    if (opened < 0) throw InputError(path_, "its decoder cannot be opened: " + ffmpeg::explain(opened));
  }

  int64_t expectedFrames() const { return stream_->nb_frames; }
  int64_t duration() const {
    return stream_->duration > 0 ? av_rescale_q(stream_->duration, stream_->time_base, {1, 1000000}) : 0;
  }
  int rotation_deg() const { return rotation_deg_; }
  double pixelAspect() const {
    const double stored = pixelAspectOf(*stream_);
    return rotation_deg_ % 180 == 0 ? stored : 1 / stored;
  }

  std::vector<std::string> warnings() const {
    std::vector<std::string> all;
    if (rotation_deg_ != 0) {
      all.push_back(
          "the images are turned by " + std::to_string(rotation_deg_) +
          " degrees clockwise, as the video states: camera matrix and R_CI are those of the turned images");
    }
    if (pixelAspect() != 1) {
      all.push_back("the pixels are not square: camera.fy is " + std::to_string(pixelAspect()) +
                    " times camera.fx");
    }
    if (2 * interlaced_ > frames_) {
      all.emplace_back(
          "the video is interlaced, each image shows two moments, and what moves has combs: deinterlace it "
          "first "
          "(ffmpeg -i F -vf bwdif G)");
    }
    if (const VideoChoice choice = choiceOf(*input_, *stream_); choice.of > 1) {
      all.push_back("the file holds " + std::to_string(choice.of) + " videos: number " +
                    std::to_string(choice.number) + " is taken");
    }
    if (options_.fps > 0 && !times_->usesRate())
      all.push_back("--fps is not used: the video has times of its own");
    if (!leaps_.line().empty()) all.push_back(leaps_.line());
    if (!damage_.empty()) {
      all.push_back(damage_ +
                    (damaged_ > 1 ? " (and " + std::to_string(damaged_ - 1) + " more such places)" : "") +
                    "; " + std::to_string(skipped_) + " frames are left out");
    }
    return all;
  }

  std::optional<VideoFrame> next() {
    while (true) {
      const int received = avcodec_receive_frame(decoder_.get(), frame_.get());
      if (received == 0) {
        if (auto frame = take()) return frame;
      } else if (received == AVERROR_EOF) {
        if (!resume()) return finish();
      } else if (received == AVERROR(EAGAIN)) {
        feed();
      } else {
        if (!options_.keep_going) failAfterLast("cannot be decoded: " + ffmpeg::explain(received));
        drain("cannot be decoded: " + ffmpeg::explain(received), false);
      }
    }
  }

 private:
  std::string afterLast(const std::string& what) const {
    if (frames_ == 0) return "first frame " + what;
    return "is damaged or cut short: what follows frame " + std::to_string(frames_ - 1) + " (" +
           std::to_string(static_cast<double>(last_utime_) / 1e6) + " s), the last good one, " + what;
  }
  [[noreturn]] void failAfterLast(const std::string& what) const { throw InputError(path_, afterLast(what)); }

  void feed() {
    while (true) {
      const int read = av_read_frame(input_.get(), packet_.get());
      if (read == AVERROR_EOF) return drain(missingPackets(), true);
      if (read < 0) return drain("cannot be read: " + ffmpeg::explain(read), true);
      const bool ours = packet_->stream_index == stream_->index;
      const bool corrupt = (packet_->flags & AV_PKT_FLAG_CORRUPT) != 0;
      if ((packet_->flags & AV_PKT_FLAG_KEY) != 0 && !corrupt) waits_for_key_ = false;
      const bool decodes = ours && !corrupt && !waits_for_key_;
      if (decodes) times_->onPacket(*packet_);
      const int sent = decodes ? avcodec_send_packet(decoder_.get(), packet_.get()) : 0;
      av_packet_unref(packet_.get());
      if (!ours) continue;
      packets_ += corrupt ? 0 : 1;
      if (!decodes || sent < 0) ++skipped_;
      if (corrupt) return drain("is cut short", false);
      if (sent < 0) return drain("cannot be decoded: " + ffmpeg::explain(sent), false);
      if (decodes) return;
    }
  }

  /// The decoder still holds frames: they are returned first, the error (if any) after the last good one.
  void drain(const std::string& complaint, bool at_end) {
    complaint_ = complaint;
    at_end_ = at_end;
    avcodec_send_packet(decoder_.get(), nullptr);
  }

  /// After damage: on from the next key frame. False at the end.
  bool resume() {
    if (!options_.keep_going) return false;
    if (!complaint_.empty()) {
      if (damaged_++ == 0) damage_ = (frames_ == 0 ? "the video's " : "the video ") + afterLast(complaint_);
      complaint_.clear();
    }
    if (at_end_) return false;
    avcodec_flush_buffers(decoder_.get());
    times_->restart();
    waits_for_key_ = true;
    return true;
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
    const auto utime = times_->timeOf(*frame_);
    if (!utime && !options_.keep_going) failAfterLast("has no presentation time");
    if (utime && frames_ > 0 && leaps_.isOne(path_, frames_, last_utime_, *utime)) return std::nullopt;
    if (!utime || (frames_ > 0 && *utime <= last_utime_)) {
      const std::string fault = !utime ? "a frame without a time"
                                       : "time runs backwards or repeats at frame " +
                                             std::to_string(frames_) + ": " + std::to_string(*utime) +
                                             " us after " + std::to_string(last_utime_) + " us";
      if (!options_.keep_going) throw InputError(path_, fault);
      if (damaged_++ == 0) damage_ = fault;
      ++skipped_;
      return std::nullopt;
    }
    VideoFrame out;
    out.utime = *utime;
    out.image = convert();
    last_utime_ = out.utime;
    ++frames_;
    interlaced_ += frame_->interlaced_frame != 0 ? 1 : 0;
    av_frame_unref(frame_.get());
    return out;
  }

  cv::Mat convert() {
    if (frame_->width != size_.width || frame_->height != size_.height) {
      if (!size_.empty()) failAfterLast("has another resolution");
      size_ = {frame_->width, frame_->height};
    }
    cv::Mat image = converter_->convert(*frame_);
    if (image.empty()) throw InputError(path_, "its pixel format cannot be converted");
    return image;
  }

  std::filesystem::path path_;
  VideoReaderOptions options_;
  ffmpeg::Input input_;
  AVStream* stream_;
  ffmpeg::CodecContext decoder_;
  std::unique_ptr<FrameConverter> converter_;
  std::unique_ptr<FrameTimes> times_;
  ffmpeg::Packet packet_;
  ffmpeg::Frame frame_;
  FrameLeaps leaps_;
  int rotation_deg_ = 0;
  cv::Size size_;
  std::string complaint_;
  std::string damage_;  ///< the first that was passed over
  bool at_end_ = false;
  bool waits_for_key_ = false;
  int64_t damaged_ = 0;
  int64_t skipped_ = 0;
  int64_t frames_ = 0;
  int64_t interlaced_ = 0;  ///< of those
  int64_t packets_ = 0;
  int64_t last_utime_ = 0;
};

VideoReader::VideoReader(const std::filesystem::path& path, const VideoReaderOptions& options)
    : implementation_(std::make_unique<Implementation>(path, options)) {}
VideoReader::~VideoReader() = default;
std::optional<VideoFrame> VideoReader::next() { return implementation_->next(); }
int64_t VideoReader::expectedFrames() const { return implementation_->expectedFrames(); }
int64_t VideoReader::duration() const { return implementation_->duration(); }
double VideoReader::pixelAspect() const { return implementation_->pixelAspect(); }
int VideoReader::rotation_deg() const { return implementation_->rotation_deg(); }
std::vector<std::string> VideoReader::warnings() const { return implementation_->warnings(); }

}  // namespace redbee
