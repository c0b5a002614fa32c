#include "processes/redbee/export/export_mcap.hpp"

#include <algorithm>
#include <cctype>
#include <limits>

#include "processes/detection_messages.hpp"
#include "processes/redbee/export/camera_infos.hpp"
#include "processes/redbee/export/ros_export.hpp"
#include "processes/redbee/export/ros_schemas.hpp"
#include "redbee/bus/build_version.hpp"
#include "redbee/bus/message_name.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/configuration/configuration_files.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"
#include "redbee/files/log.hpp"
#include "redbee/files/mcap_writer.hpp"
#include "redbee/files/progress.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/node/message_check.hpp"
#include "redbee/results/run_folder.hpp"

namespace redbee {
namespace {

/// MCAP counts in nanoseconds.
constexpr int64_t kLatest_us = std::numeric_limits<int64_t>::max() / 1000;

std::string topicOf(const std::string& channel) {
  std::string topic = "/";
  for (const char c : channel) {
    const auto byte = static_cast<unsigned char>(c);
    topic += std::isalnum(byte) != 0 ? static_cast<char>(std::tolower(byte)) : '_';
  }
  return topic;
}

class Exporter {
 public:
  explicit Exporter(const McapExport& options)
      : options_(options), writer_(options.out, "ros2", std::string("redbee ") + releaseVersion()) {
    if (options.configuration) {
      const Configuration configuration = loadConfiguration(*options.configuration);
      lens_channel_ = configuration.channels.lens;
      cameras_.emplace(
          configuration, [this](const std::string& topic, int64_t utime, const CameraIntrinsics& camera) {
            write(topic + "/camera_info", cameraInfoSchema(), utime, exportCameraInfo(utime, camera));
          });
    }
    if (!options.results) return;
    for (const auto& [utime, box] : RunFolder(*options.results).detections()) boxes_[utime].push_back(box);
  }

  void add(const LogEvent& event) {
    const std::string name = messageName(event.data);
    bool is_known =
        take<image_t>(name, event, [&](const image_t& image) { addImage(event.channel, image); }) ||
        take<ins_t>(name, event,
                    [&](const ins_t& imu) {
                      write(topicOf(event.channel), imuSchema(), imu.utime, exportImu(imu));
                    }) ||
        take<altimeter_t>(name, event,
                          [&](const altimeter_t& altitude) {
                            write(topicOf(event.channel), rangeSchema(), altitude.utime,
                                  exportRange(altitude));
                          }) ||
        take<detections_t>(name, event,
                           [&](const detections_t& message) { addDetections(event.channel, message); }) ||
        take<foreground_t>(name, event,
                           [&](const foreground_t& message) { addForeground(event.channel, message); }) ||
        take<process_health_t>(name, event,
                               [&](const process_health_t& health) { addHealth(event.channel, health); });
    if (cameras_ && event.channel == lens_channel_) {
      is_known |= take<lens_t>(name, event, [&](const lens_t& lens) { cameras_->add(lens); });
    }
    if (!is_known) ++exported_.left_out[event.channel];
  }

  McapExported finish() {
    if (cameras_) cameras_->finish();
    if (exported_.messages.empty())
      throw InputError(options_.log,
                       "holds no message that is exported (images, IMU, altimeter, detections, health)");
    if (options_.results && frames_with_boxes_ == 0 && !boxes_.empty())
      throw InputError(*options_.results / "detections.csv",
                       "is of another flight: no box is of a frame of " + options_.log.string());
    writer_.close();
    return std::move(exported_);
  }

 private:
  template <typename Message, typename Use>
  bool take(const std::string& name, const LogEvent& event, const Use& use) {
    if (name != Message::getTypeName()) return false;
    Message message;
    if (decodePlausible(event.data, message) && message.utime >= 0 && message.utime <= kLatest_us) {
      use(message);
    } else {
      ++exported_.damaged;
    }
    return true;
  }

  void write(const std::string& topic, const McapSchema& schema, int64_t utime, const CdrBytes& bytes) {
    auto channel = channels_.find(topic);
    if (channel == channels_.end())
      channel = channels_.emplace(topic, writer_.addChannel(topic, schema, "cdr")).first;
    writer_.write(channel->second, 1000 * utime, bytes);
    ++exported_.messages[topic];
  }

  void addImage(const std::string& channel, const image_t& image) {
    const std::string topic = topicOf(channel);
    if (image.pixelformat == image_t::MJPEG) {
      write(topic + "/image", compressedImageSchema(), image.utime,
            exportCompressedImage(image.utime, image.data, "jpeg"));
    } else if (const CdrBytes raw = exportRawImage(image); !raw.empty()) {
      write(topic + "/image", rawImageSchema(), image.utime, raw);
    } else {
      ++exported_.damaged;
      return;
    }
    if (cameras_) cameras_->add(topic, image);
    addResults(image.utime);
  }

  /// An empty list, too: it ends the boxes of the frame before.
  void addResults(int64_t utime) {
    if (!options_.results) return;
    const auto found = boxes_.find(utime);
    if (found != boxes_.end()) ++frames_with_boxes_;
    write("/detections", imageAnnotationsSchema(), utime,
          exportBoxes(utime, found == boxes_.end() ? std::vector<Detection>{} : found->second));
  }

  void addDetections(const std::string& channel, const detections_t& message) {
    if (options_.results) {
      ++exported_.left_out[channel];
      return;
    }
    std::vector<Detection> boxes;
    for (const detection_t& d : message.detections) boxes.push_back(detectionOf(d));
    write(topicOf(channel), imageAnnotationsSchema(), message.utime, exportBoxes(message.utime, boxes));
  }

  void addForeground(const std::string& channel, const foreground_t& message) {
    if (message.status != foreground_t::GOOD) {
      ++exported_.left_out[channel];
      return;
    }
    const std::string topic = topicOf(channel);
    write(topic + "/mask", compressedImageSchema(), message.utime,
          exportCompressedImage(message.utime, message.mask, "png"));
    write(topic + "/probability", compressedImageSchema(), message.utime,
          exportCompressedImage(message.utime, message.probability, "png"));
  }

  void addHealth(const std::string& channel, const process_health_t& health) {
    write(topicOf(channel) + topicOf(health.process), processHealthSchema(), health.utime,
          exportHealth(health));
    std::string& before = lines_[health.process];
    const std::string line = std::to_string(health.state) + health.message;
    if (line == before) return;
    before = line;
    write("/log", logSchema(), health.utime, exportLog(health));
  }

  const McapExport& options_;
  McapWriter writer_;
  std::optional<CameraInfos> cameras_;
  std::string lens_channel_;
  std::map<int64_t, std::vector<Detection>> boxes_;
  std::map<std::string, uint16_t> channels_;
  std::map<std::string, std::string> lines_;  ///< the latest of each process
  int64_t frames_with_boxes_ = 0;
  McapExported exported_;
};

}  // namespace

McapExported exportMcap(const McapExport& options) {
  std::vector<std::filesystem::path> inputs{options.log};
  if (options.results) inputs.push_back(*options.results / "detections.csv");
  requireNoInput(options.out, inputs);
  if (options.configuration) requireNoInput(options.out, *options.configuration, {});
  LogReader log(options.log);
  Exporter exporter(options);
  Progress progress("exporting " + options.log.string(), "bytes");
  while (const auto event = log.next()) {
    exporter.add(*event);
    progress.update(log.position(), log.size());
  }
  McapExported exported = exporter.finish();
  if (!log.damageReport().empty()) exported.warnings.push_back(log.damageReport());
  return exported;
}

}  // namespace redbee
