#include "redbee/importers/ros/import_ros.hpp"

#include <spdlog/fmt/fmt.h>

#include "redbee/files/input_error.hpp"
#include "redbee/importers/flight_merger.hpp"
#include "redbee/importers/ros/ros_images.hpp"
#include "redbee/importers/ros/ros_sensors.hpp"
#include "redbee/importers/ros/ros_topics.hpp"

namespace redbee {
namespace {

/// Of a sequence whose first whole image has 16 bits.
std::optional<GreyRange> rangeOfImages(RosRecording& recording, const RosTopic& topic,
                                       const ImportOptions& options) {
  ValueHistogram histogram;
  std::optional<bool> is_16_bits;
  recording.read({topic.name}, [&](const RosMessage& message) {
    try {
      const auto values = valuesOf16BitRosImage(message, options.source);
      if (!is_16_bits) is_16_bits = values.has_value();
      if (values) histogram.add(*values);
    } catch (const RosMessageError&) {  // what is damaged is reported when the images are converted
    } catch (const InputError&) {
    }
    return is_16_bits.value_or(true);
  });
  if (!is_16_bits.value_or(false)) return std::nullopt;
  return histogram.range();
}

class ImageTrack {
 public:
  /// `keep`: one for each message.
  ImageTrack(const RosTopic& topic, const ImportOptions& options, std::optional<GreyRange> range,
             const std::vector<bool>& keep)
      : topic_(topic), options_(options), images_{true, options.jpeg_quality, range}, keep_(keep) {}

  void add(const RosMessage& message, FlightMerger& merger, ImportSummary& summary) {
    const auto place = static_cast<size_t>(number_++);
    if (place >= keep_.size() || !keep_[place]) return;  // grown since, or its time cannot be true
    std::optional<LoadedImage> image;
    try {
      image = convertRosImage(message, topic_.name + ", message " + std::to_string(number_), images_);
    } catch (const RosMessageError& error) {
      leaveOut(faultOfMessage(options_.source, topic_.name, number_, error.what()));
    } catch (const InputError& error) {
      leaveOut(options_.source.string() + ": " + error.what());
    }
    if (!image) return;
    const image_t& frame = image->message;
    resolution_.check(options_.source.string() + ": " + topic_.name, frame);
    summary.vehicle.width = frame.width;
    summary.vehicle.height = frame.height;
    ++frames_;
    merger.addFrame(frame);
  }

  /// Throws InputError if there was no image.
  void finish(ImportSummary& summary) const {
    if (frames_ == 0)
      throw InputError(damaged_ > 0 ? first_fault_
                                    : options_.source.string() + ": " + topic_.name + ": no images");
    if (damaged_ > 0)
      summary.warnings.push_back(fmt::format("{} of {} images are damaged and left out; the first: {}",
                                             damaged_, number_, first_fault_));
  }

  int64_t number() const { return number_; }

 private:
  void leaveOut(const std::string& fault) {
    if (!options_.keep_going) throw InputError(fault);
    if (damaged_++ == 0) first_fault_ = fault;
  }

  const RosTopic& topic_;
  const ImportOptions& options_;
  ImageOptions images_;
  const std::vector<bool>& keep_;
  ResolutionCheck resolution_;
  int64_t number_ = 0;
  int64_t frames_ = 0;
  int64_t damaged_ = 0;
  std::string first_fault_;
};

/// A camera_info of another size is of another camera, or of another mode of this one.
void setIntrinsics(const RosCameraInfo& info, const RosTopics& topics, const ImportOptions& options,
                   ImportSummary& summary) {
  VehicleDescription& vehicle = summary.vehicle;
  vehicle.intrinsics = intrinsicsOf(info, topics.image.name, options.source);
  if (!vehicle.intrinsics) {
    summary.warnings.push_back(topics.camera_info->name + ": the camera is not calibrated");
    return;
  }
  if (vehicle.intrinsics->width != vehicle.width || vehicle.intrinsics->height != vehicle.height) {
    throw InputError(options.source,
                     fmt::format("{} is of {}x{} px, the images on {} have {}x{}: choose another with "
                                 "--camera-info-topic, or none",
                                 topics.camera_info->name, info.width, info.height, topics.image.name,
                                 vehicle.width, vehicle.height));
  }
}

}  // namespace

ImportSummary importRosRecording(RosRecording& recording, const ImportOptions& options, Progress& progress) {
  const RosTopics topics = chooseRosTopics(recording.topics(), options.topics, options.source);
  const RosSensors sensors = readRosSensors(recording, topics, options);
  ImportSummary summary;
  summary.vehicle.name = std::filesystem::weakly_canonical(options.source).stem().string();
  summary.warnings = sensors.warnings;
  FlightMerger merger(options.log, options.channels, sensors.imu, sensors.altitudes);
  if (topics.imu) merger.requirePlausibleImu(options.source, options.units);
  ImageTrack track(topics.image, options, rangeOfImages(recording, topics.image, options),
                   sensors.keep_image);
  recording.read({topics.image.name}, [&](const RosMessage& message) {
    track.add(message, merger, summary);
    progress.update(track.number(), topics.image.messages);
    return true;
  });
  const std::vector<std::string> warnings = recording.warnings();
  summary.warnings.insert(summary.warnings.begin(), warnings.begin(), warnings.end());
  track.finish(summary);
  if (sensors.camera_info) setIntrinsics(*sensors.camera_info, topics, options, summary);
  merger.close(summary);
  summary.vehicle.start_height =
      startHeight(sensors.altitudes, toImu(CameraTime(fromUtime(summary.first_utime)), Duration(0)));
  return summary;
}

Importer rosImporter(const std::string& name, const std::string& description, const std::string& source,
                     ImportSummary (*import)(const ImportOptions&, Progress&)) {
  Importer importer;
  importer.name = name;
  importer.description = description;
  importer.source = source;
  importer.takes.units = true;
  importer.takes.keep_going = true;
  importer.takes.topics = true;
  importer.defaults.jpeg_quality = 95;
  importer.import = import;
  return importer;
}

}  // namespace redbee
