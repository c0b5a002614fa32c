#include "processes/redbee/calibrate/calibration_log.hpp"

#include <cmath>
#include <cstdio>
#include <deque>
#include <optional>
#include <string>
#include <utility>

#include "processes/lens_messages.hpp"
#include "processes/warnings.hpp"
#include "redbee/altimeter_t.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/log.hpp"
#include "redbee/files/progress.hpp"
#include "redbee/image_t.hpp"
#include "redbee/imaging/rectifier.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/lens_t.hpp"
#include "redbee/node/message_check.hpp"
#include "redbee/visual/homography_estimation.hpp"
#include "redbee/visual/point_tracker.hpp"

namespace redbee {
namespace {

/// Tracks points over several frames at once if the image moves slowly, so that a facade's parallax and the
/// rotation exceed the tracking noise. Frames in between only propagate the initial guess.
class LongBaseline {
 public:
  /// `delay`: frames to skip before the first match.
  LongBaseline(const TrackerParameters& tracker, const cv::Mat& unknown, int delay)
      : tracker_(tracker, unknown), delay_(delay) {}

  /// `step`: from the previous frame to this one. The match that ends at this frame, where one does.
  std::optional<calibration::GroundMatch> advance(CameraTime time, const cv::Mat& ideal,
                                                  const std::optional<HomographyEstimate>& step) {
    size_ = ideal.size();
    if (delay_-- > 0) return std::nullopt;
    ++frames_;
    if (!step || begin_ == CameraTime()) {
      tracker_.advance(ideal, std::nullopt);
      begin(time);
      return std::nullopt;
    }
    chain_ = normaliseHomography(step->H * chain_);
    if (motion() < kEnoughMotion_px && frames_ < kMostFrames) return std::nullopt;
    const CameraTime from = begin_;
    const bool worthwhile = frames_ >= kFewestFrames;
    PointTracks tracks = tracker_.advance(ideal, chain_);
    begin(time);
    if (!worthwhile || tracks.current.empty()) return std::nullopt;
    return calibration::GroundMatch{from, time, std::move(tracks)};
  }

 private:
  static constexpr double kEnoughMotion_px = 40;
  static constexpr int kMostFrames = 12;
  static constexpr int kFewestFrames = 3;

  void begin(CameraTime time) {
    begin_ = time;
    chain_.setIdentity();
    frames_ = 0;
  }
  /// Mean over points half-way to the corners [px].
  double motion() const {
    const double w = size_.width, h = size_.height;
    double sum = 0;
    for (const Eigen::Vector2d& p :
         {Eigen::Vector2d(0.25 * w, 0.25 * h), Eigen::Vector2d(0.75 * w, 0.25 * h),
          Eigen::Vector2d(0.25 * w, 0.75 * h), Eigen::Vector2d(0.75 * w, 0.75 * h)}) {
      sum += (transfer(chain_, p) - p).norm() / 4;
    }
    return sum;
  }

  PointTracker tracker_;
  cv::Size size_;
  Eigen::Matrix3d chain_ = Eigen::Matrix3d::Identity();  ///< from the frame that the match begins at
  CameraTime begin_{};
  int frames_ = 0;
  int delay_;
};

class LogIntake {
 public:
  LogIntake(const std::filesystem::path& log, const Configuration& configuration,
            calibration::CalibrationInput& input)
      : log_(log),
        configuration_(configuration),
        input_(input),
        rectifier_(Camera(configuration.camera), configuration.own_parts),
        tracker_(configuration.visual.tracker, rectifier_.unknown()) {
    for (const int delay : {0, 3, 6, 9})
      long_baselines_.emplace_back(configuration.visual.tracker, rectifier_.unknown(), delay);
  }

  /// All but the pixels.
  void takeSamples(const LogEvent& event) {
    const Channels& channels = configuration_.channels;
    if (event.channel == channels.imu) return onImu(event);
    if (event.channel == channels.altimeter && configuration_.has_altimeter) return takeAltitude(event);
    if (event.channel == channels.camera) return takeTime(event);
    if (event.channel == channels.lens && configuration_.inertial.lens.enabled) return checkLens(event);
  }
  /// Tracking takes minutes, which are lost where the samples are not enough.
  void requireSamples() {
    if (input_.frames.empty()) throw InputError(log_, "holds no image on " + configuration_.channels.camera);
    if (input_.imu.empty()) throw InputError(log_, "holds no IMU sample on " + configuration_.channels.imu);
    try {
      calibration::requireCoverage(input_);
    } catch (const calibration::CalibrationError& error) {
      throw InputError(log_, error.what());
    }
    input_.frames.clear();  // those that can be decoded follow
  }
  void takeImageOf(const LogEvent& event) {
    if (event.channel == configuration_.channels.camera) takeImage(event);
  }

  void finish() const {
    if (input_.frames.empty())
      throw InputError(log_, "no image on " + configuration_.channels.camera + " can be decoded");
    if (damaged_ > 0)
      printWarning(log_.string() + ": " + std::to_string(damaged_) + " damaged messages skipped");
  }

 private:
  void onImu(const LogEvent& event) {
    ins_t message;
    if (!decodePlausible(event.data, message)) return noteDamaged();
    input_.imu.push_back({ImuTime(fromUtime(message.utime)),
                          {message.gyro[0], message.gyro[1], message.gyro[2]},
                          {message.accel[0], message.accel[1], message.accel[2]}});
  }

  void takeTime(const LogEvent& event) {
    image_t message;
    if (decodePlausible(event.data, message)) input_.frames.emplace_back(fromUtime(message.utime));
  }

  void takeAltitude(const LogEvent& event) {
    altimeter_t message;
    if (!decodePlausible(event.data, message)) return noteDamaged();
    input_.altimeter.push_back({ImuTime(fromUtime(message.utime)), message.height, message.sigma});
  }

  /// One focal length is calibrated.
  void checkLens(const LogEvent& event) const {
    constexpr double kSame = 0.01;  // an error of the focal length that a calibration can bear
    lens_t message;
    if (!decodePlausible(event.data, message)) return;
    const auto lens = lensSampleOf(message, configuration_);
    if (!lens || std::abs(lens->zoom - 1) <= kSame) return;
    throw InputError(
        log_, "event " + std::to_string(event.number) + ": " + configuration_.channels.lens + " says " +
                  std::to_string(lens->zoom) +
                  " times the focal length of camera.fx: calibrate at that one (lens.focal_length_px)");
  }

  void takeImage(const LogEvent& event) {
    image_t message;
    if (!decodePlausible(event.data, message)) return noteDamaged();
    const auto grey = decodeGrey(message);
    if (!grey) return noteDamaged();
    if (grey->cols != configuration_.camera.width || grey->rows != configuration_.camera.height) {
      throw InputError(log_, "event " + std::to_string(event.number) + ": image of " +
                                 std::to_string(grey->cols) + "x" + std::to_string(grey->rows) +
                                 ", configured are " + std::to_string(configuration_.camera.width) + "x" +
                                 std::to_string(configuration_.camera.height));
    }
    const CameraTime time(fromUtime(message.utime));
    const CameraTime previous = input_.frames.empty() ? time : input_.frames.back();
    // A duplicate or late image would be tracked backwards.
    if (!input_.frames.empty() && time <= previous) return;
    const cv::Mat ideal = rectifier_.toIdeal(*grey);
    PointTracks points = tracker_.advance(ideal, std::nullopt);
    const auto step = estimateHomography(points, ideal.cols, ideal.rows, configuration_.visual.ransac);
    for (LongBaseline& baseline : long_baselines_) {
      if (auto match = baseline.advance(time, ideal, step)) input_.ground.push_back(std::move(*match));
    }
    input_.frames.push_back(time);
    const double gap_s = seconds(time - previous);
    if (points.current.empty() || gap_s > configuration_.visual.max_frame_gap_s) return;
    input_.ground.push_back({previous, time, std::move(points)});
  }

  void noteDamaged() { ++damaged_; }

  std::filesystem::path log_;
  const Configuration& configuration_;
  calibration::CalibrationInput& input_;
  Rectifier rectifier_;
  PointTracker tracker_;
  std::deque<LongBaseline> long_baselines_;  ///< staggered, so that their matches overlap
  int damaged_ = 0;
};

}  // namespace

void readCalibrationLog(const std::filesystem::path& log, const Configuration& configuration, bool quiet,
                        calibration::CalibrationInput& input) {
  LogReader reader(log);
  LogIntake intake(log, configuration, input);
  while (const auto event = reader.next()) intake.takeSamples(*event);
  intake.requireSamples();
  reader.rewind();
  Progress progress("tracking in " + log.filename().string(), "MB", quiet);
  while (const auto event = reader.next()) {
    intake.takeImageOf(*event);
    progress.update(reader.position() >> 20, reader.size() >> 20);
  }
  progress.finish();
  printWarning(reader.damageReport());
  intake.finish();
}

}  // namespace redbee
