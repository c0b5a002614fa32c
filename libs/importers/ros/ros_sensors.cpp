#include "redbee/importers/ros/ros_sensors.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "redbee/files/input_error.hpp"
#include "redbee/geometry/camera_model.hpp"
#include "redbee/importers/time_check.hpp"

namespace redbee {
namespace {

// m. sensor_msgs/Range states none; a lidar or radar altimeter over grass has about this.
constexpr double kRangeSigma = 0.1;

struct Counts {
  int64_t messages = 0;
  int64_t damaged = 0;
  int64_t without_stamp = 0;
  int64_t invalid = 0;
  int64_t without_variance = 0;
  std::string first_fault;
};

ImuTime timeOf(int64_t stamp_ns, const RosMessage& message, Counts& counts) {
  if (stamp_ns == 0) ++counts.without_stamp;
  return ImuTime(fromNanoseconds(stamp_ns != 0 ? stamp_ns : message.logged_ns));
}

/// Gyro and accelerometer, or a RosMessageError.
ImuSample imuSample(const RosMessage& message, const ImuUnits& units, Counts& counts) {
  const RosImu imu = readRosImu(message.bytes, message.topic->encoding);
  if (!imu.has_gyro || !imu.has_accel)
    throw RosMessageError(std::string("has no ") +
                          (imu.has_gyro ? "linear_acceleration" : "angular_velocity") +
                          ": choose another topic with --imu-topic, or none");
  if (!imu.gyro.allFinite() || !imu.accel.allFinite())
    throw RosMessageError("has values that are not finite");
  ImuSample sample;
  sample.time = timeOf(imu.stamp_ns, message, counts);
  sample.gyro = factorOf(gyroUnits(), units.gyro, "--gyro-unit") * imu.gyro;
  sample.accel = factorOf(accelUnits(), units.accel, "--accel-unit") * imu.accel;
  return sample;
}

/// By time; those that leap or repeat one are left out. `source`: file and topic.
template <typename Sample>
void sortByTime(std::vector<Sample>& samples, const std::string& source, const std::string& topic,
                std::vector<std::string>& warnings) {
  std::vector<int64_t> utimes;
  utimes.reserve(samples.size());
  for (const Sample& sample : samples) utimes.push_back(toUtime(sample.time));
  const TimeFindings times = checkTimes(utimes, TimeOrder::kSorted, source);
  for (const std::string& line : times.lines) warnings.push_back(fmt::format("{}: {}", topic, line));
  samples = thoseKept(samples, times.keep);
  const auto isBefore = [](const Sample& a, const Sample& b) { return a.time < b.time; };
  if (!std::is_sorted(samples.begin(), samples.end(), isBefore)) {
    warnings.push_back(topic + ": messages are not in the order of their stamps; they are sorted");
    std::stable_sort(samples.begin(), samples.end(), isBefore);
  }
  const auto end = std::unique(samples.begin(), samples.end(),
                               [](const Sample& a, const Sample& b) { return a.time == b.time; });
  if (end == samples.end()) return;
  warnings.push_back(fmt::format("{}: {} messages repeat the stamp of another and are left out", topic,
                                 samples.end() - end));
  samples.erase(end, samples.end());
}

/// The stamps of the images; one that cannot be read has none.
class ImageTimes {
 public:
  void add(const RosMessage& message, Counts& counts) {
    try {
      const int64_t stamp = readRosImageStamp(message.topic->type, message.bytes, message.topic->encoding);
      utimes_.push_back(toUtime(timeOf(stamp, message, counts)));
      places_.push_back(messages_);
    } catch (const RosMessageError&) {  // reported when the images are converted
    }
    ++messages_;
  }
  std::vector<bool> check(const std::string& source, const std::string& topic,
                          std::vector<std::string>& warnings) const {
    const TimeFindings times = checkTimes(utimes_, TimeOrder::kAsTheyCome, source);
    for (const std::string& line : times.lines) warnings.push_back(fmt::format("{}: {}", topic, line));
    std::vector<bool> keep(messages_, true);
    for (size_t i = 0; i < places_.size(); ++i) keep[places_[i]] = times.keep[i];
    return keep;
  }

 private:
  std::vector<int64_t> utimes_;
  std::vector<size_t> places_;
  size_t messages_ = 0;
};

void warnOf(const std::string& topic, const Counts& counts, std::vector<std::string>& warnings) {
  if (counts.damaged > 0) {
    warnings.push_back(fmt::format("{}: {} of {} messages are damaged and left out; the first {}", topic,
                                   counts.damaged, counts.messages, counts.first_fault));
  }
  if (counts.without_stamp > 0) {
    warnings.push_back(fmt::format(
        "{}: {} of {} messages have no stamp: they get the time of their recording, which jitters", topic,
        counts.without_stamp, counts.messages));
  }
  if (counts.without_variance > 0)
    warnings.push_back(fmt::format("{}: a sigma of {:g} m is assumed", topic, kRangeSigma));
  if (counts.invalid > 0) {
    warnings.push_back(fmt::format("{}: {} of {} ranges are outside of the sensor's limits and left out",
                                   topic, counts.invalid, counts.messages));
  }
}

void addRange(const RosMessage& message, RosSensors& sensors, Counts& counts) {
  const RosRange range = readRosRange(message.bytes, message.topic->encoding);
  const bool has_limits = range.most > range.least;
  const bool is_valid = std::isfinite(range.range) && range.range > 0 &&
                        (!has_limits || (range.range >= range.least && range.range <= range.most));
  if (!is_valid) {
    ++counts.invalid;
    return;
  }
  const bool has_variance = std::isfinite(range.variance) && range.variance > 0;
  if (!has_variance) ++counts.without_variance;
  const double sigma = has_variance ? std::sqrt(range.variance) : kRangeSigma;
  sensors.altitudes.push_back({timeOf(range.stamp_ns, message, counts), range.range, sigma});
}

void addMessage(const RosMessage& message, const ImportOptions& options, RosSensors& sensors,
                Counts& counts) {
  switch (rosKindOf(message.topic->type)) {
    case RosKind::kImu:
      sensors.imu.push_back(imuSample(message, options.units, counts));
      break;
    case RosKind::kRange:
      addRange(message, sensors, counts);
      break;
    case RosKind::kCameraInfo:
      if (!sensors.camera_info)
        sensors.camera_info = readRosCameraInfo(message.bytes, message.topic->encoding);
      break;
    default:
      break;
  }
}

bool isRectified(const std::string& image_topic) {
  return image_topic.find("image_rect") != std::string::npos;
}

}  // namespace

std::string faultOfMessage(const std::filesystem::path& file, const std::string& topic, int64_t number,
                           const std::string& what) {
  return fmt::format("{}: {}, message {}: {}", file.string(), topic, number, what);
}

RosSensors readRosSensors(RosRecording& recording, const RosTopics& topics, const ImportOptions& options) {
  std::map<std::string, Counts> counts;
  counts[topics.image.name];
  for (const auto* topic : {&topics.imu, &topics.range, &topics.camera_info}) {
    if (*topic) counts[(*topic)->name];
  }
  std::set<std::string> names;
  for (const auto& [name, count] : counts) names.insert(name);
  RosSensors sensors;
  ImageTimes images;
  recording.read(names, [&](const RosMessage& message) {
    Counts& count = counts[message.topic->name];
    ++count.messages;
    try {
      if (message.topic->name == topics.image.name) {
        images.add(message, count);
      } else {
        addMessage(message, options, sensors, count);
      }
    } catch (const RosMessageError& error) {
      if (!options.keep_going)
        throw InputError(faultOfMessage(options.source, message.topic->name, count.messages, error.what()));
      if (count.damaged++ == 0) count.first_fault = error.what();
    }
    return true;
  });
  for (const auto& [name, count] : counts) warnOf(name, count, sensors.warnings);
  const auto source = [&](const RosTopic& topic) { return options.source.string() + ": " + topic.name; };
  sensors.keep_image = images.check(source(topics.image), topics.image.name, sensors.warnings);
  if (topics.imu) sortByTime(sensors.imu, source(*topics.imu), topics.imu->name, sensors.warnings);
  if (topics.range)
    sortByTime(sensors.altitudes, source(*topics.range), topics.range->name, sensors.warnings);
  return sensors;
}

std::optional<CameraIntrinsics> intrinsicsOf(const RosCameraInfo& info, const std::string& image_topic,
                                             const std::filesystem::path& file) {
  const bool is_rectified = isRectified(image_topic) && info.P[0] > 0;
  CameraIntrinsics camera;
  camera.width = static_cast<int>(info.width);
  camera.height = static_cast<int>(info.height);
  camera.fx = is_rectified ? info.P[0] : info.K[0];
  camera.fy = is_rectified ? info.P[5] : info.K[4];
  camera.cx = is_rectified ? info.P[2] : info.K[2];
  camera.cy = is_rectified ? info.P[6] : info.K[5];
  const bool is_finite = std::isfinite(camera.fx + camera.fy + camera.cx + camera.cy);
  // K[0] = 0 is how camera_info says that the camera is not calibrated.
  if (!is_finite || camera.fx <= 0 || camera.fy <= 0) return std::nullopt;
  const bool is_ideal = std::all_of(info.D.begin(), info.D.end(), [](double k) { return k == 0; });
  if (is_rectified || is_ideal) return camera;
  const CameraModelType* type = findCameraModel(info.distortion_model);
  const std::string fault = type == nullptr ? "is not supported, only " + cameraModelNames()
                                            : coefficientFault(*type, info.D.size());
  const bool is_finite_lens =
      std::all_of(info.D.begin(), info.D.end(), [](double k) { return std::isfinite(k); });
  if (type == nullptr || !fault.empty() || !is_finite_lens) {
    throw InputError(file, "camera_info's distortion_model '" + info.distortion_model + "' " +
                               (fault.empty() ? "has coefficients that are not finite" : fault) +
                               ": calibrate with one of them and give it with --camchain, and "
                               "--camera-info-topic none");
  }
  camera.model = type->name;
  camera.distortion = info.D;
  return camera;
}

}  // namespace redbee
