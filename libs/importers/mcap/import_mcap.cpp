#include "redbee/importers/mcap/import_mcap.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>
#include <utility>

#include "redbee/files/decompress.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"
#include "redbee/files/mcap_reader.hpp"
#include "redbee/files/natural_order.hpp"
#include "redbee/files/printable.hpp"
#include "redbee/importers/ros/import_ros.hpp"
#include "redbee/importers/ros/ros_messages.hpp"

namespace redbee {
namespace {

/// rosbag2 splits a recording into bag_0.mcap, bag_1.mcap, ... in the bag's folder.
std::vector<std::filesystem::path> mcapFilesOf(const std::filesystem::path& source) {
  if (!std::filesystem::is_directory(source)) return {source};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(source)) {
    const std::filesystem::path& file = entry.path();
    if (file.extension() == ".db3" || file.extension() == ".zstd") requireFile(file);  // says what to do
    if (file.extension() == ".mcap") files.push_back(file);
  }
  if (files.empty()) throw InputError(source, "holds no .mcap file: is it a ROS 2 bag?");
  std::sort(files.begin(), files.end(), isFileNaturallyBefore);
  return files;
}

bool isReadable(const McapChannel& channel) {
  return channel.message_encoding == "cdr" || channel.message_encoding == "ros1";
}

/// ros2 bag record --compression-mode message packs each message by zstd, and CDR begins otherwise. What
/// cannot be unpacked stays as it is: no message.
class MessageUnpacker {
 public:
  ByteView unpack(ByteView data) {
    constexpr size_t kLargestMessage = 256U << 20;
    const auto size = sizeOfZstdFrame(data, kLargestMessage);
    if (!size) return data;
    Decompressed plain = decompress("zstd", data, *size);
    if (!plain.fault.empty()) return data;
    bytes_ = std::move(plain.bytes);
    return {bytes_.data(), bytes_.size()};
  }

 private:
  std::vector<uint8_t> bytes_;  ///< of the latest
};

class McapRecording : public RosRecording {
 public:
  McapRecording(const std::filesystem::path& source, bool keep_going)
      : source_(source), keep_going_(keep_going) {
    for (const std::filesystem::path& file : mcapFilesOf(source))
      parts_.push_back(std::make_unique<McapReader>(file));
    listTopics();
  }

  const std::vector<RosTopic>& topics() const override { return topics_; }
  std::vector<std::string> warnings() const override { return warnings_; }

  void read(const std::set<std::string>& names,
            const std::function<bool(const RosMessage&)>& on_message) override {
    std::map<std::string, const RosTopic*> wanted;
    for (const RosTopic& topic : topics_) {
      if (names.count(topic.name) > 0) wanted[topic.name] = &topic;
    }
    bool goes_on = true;
    MessageUnpacker unpacker;
    for (const auto& part : parts_) {
      if (!goes_on) return;
      part->read([&](const McapMessage& message) {
        const auto topic = wanted.find(message.channel->topic);
        const bool is_wanted = topic != wanted.end() && isReadable(*message.channel) &&
                               message.channel->schema.name == topic->second->type;
        goes_on = !is_wanted || on_message({topic->second, message.log_ns, unpacker.unpack(message.data)});
        return goes_on;
      });
      takeDamage(*part);
    }
  }

 private:
  void listTopics() {
    std::map<std::string, RosTopic> by_name;
    std::map<std::string, std::string> others;  // encoding by topic
    const auto add = [&](const McapChannel& channel, int64_t messages) {
      if (!isReadable(channel)) {
        others[channel.topic] = channel.message_encoding + " " + channel.schema.name;
        return;
      }
      RosTopic& topic = by_name[channel.topic];
      if (topic.messages == 0) {
        topic.name = channel.topic;
        topic.type = channel.schema.name;
        topic.encoding = channel.message_encoding == "cdr" ? RosEncoding::kCdr : RosEncoding::kRos1;
      }
      topic.messages += messages;
    };
    for (const auto& part : parts_) {
      if (const auto summary = part->summary()) {
        for (const auto& [channel, messages] : *summary) add(channel, messages);
        continue;
      }
      part->read([&](const McapMessage& message) {
        add(*message.channel, 1);
        return true;
      });
      takeDamage(*part);
    }
    for (const auto& [name, topic] : by_name) topics_.push_back(topic);
    refuseOtherEncodings(others);
  }

  /// Of what has been read.
  void takeDamage(const McapReader& part) {
    const std::string& damage = part.damage();
    if (damage.empty()) return;
    if (!keep_going_) throw InputError(damage + "; --keep-going imports what is whole");
    const std::string line = damage + ": what is whole is imported";
    if (std::find(warnings_.begin(), warnings_.end(), line) == warnings_.end()) warnings_.push_back(line);
  }

  /// Where no image can be read but something else is there, say what.
  void refuseOtherEncodings(const std::map<std::string, std::string>& others) const {
    for (const RosTopic& topic : topics_) {
      const RosKind kind = rosKindOf(topic.type);
      if (kind == RosKind::kImage || kind == RosKind::kCompressedImage) return;
    }
    if (others.empty()) return;
    std::vector<std::string> list;
    list.reserve(others.size());
    for (const auto& [topic, encoding] : others) list.push_back(fmt::format("{} ({})", topic, encoding));
    throw InputError(
        source_, "holds no images of ROS messages (cdr, ros1); what it has is not read: " + firstTenOf(list));
  }

  std::filesystem::path source_;
  std::vector<std::unique_ptr<McapReader>> parts_;  ///< in the order of the recording
  bool keep_going_;
  std::vector<RosTopic> topics_;
  std::vector<std::string> warnings_;
};

ImportSummary importMcap(const ImportOptions& options, Progress& progress) {
  return importRosRecording(*openMcap(options.source, options.keep_going), options, progress);
}

}  // namespace

std::unique_ptr<RosRecording> openMcap(const std::filesystem::path& source, bool keep_going) {
  return std::make_unique<McapRecording>(source, keep_going);
}

Importer mcapImporter() {
  return rosImporter("mcap", "MCAP, as rosbag2 and Foxglove record it: images, IMU, range, camera_info",
                     "F.mcap, or the folder of a ROS 2 bag", importMcap);
}

}  // namespace redbee
