#include "redbee/importers/mcap/import_mcap.hpp"

#include <map>
#include <utility>

#include "redbee/files/input_error.hpp"
#include "redbee/files/mcap_reader.hpp"
#include "redbee/files/printable.hpp"
#include "redbee/importers/ros/import_ros.hpp"
#include "redbee/importers/ros/ros_messages.hpp"

namespace redbee {
namespace {

bool isReadable(const McapChannel& channel) {
  return channel.message_encoding == "cdr" || channel.message_encoding == "ros1";
}

class McapRecording : public RosRecording {
 public:
  McapRecording(std::filesystem::path file, bool keep_going)
      : file_(std::move(file)), reader_(file_), keep_going_(keep_going) {
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
    reader_.read([&](const McapMessage& message) {
      const auto topic = wanted.find(message.channel->topic);
      const bool is_wanted = topic != wanted.end() && isReadable(*message.channel) &&
                             message.channel->schema.name == topic->second->type;
      return !is_wanted || on_message({topic->second, message.log_ns, message.data});
    });
    takeDamage();
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
    if (const auto summary = reader_.summary()) {
      for (const auto& [channel, messages] : *summary) add(channel, messages);
    } else {
      reader_.read([&](const McapMessage& message) {
        add(*message.channel, 1);
        return true;
      });
      takeDamage();
    }
    for (const auto& [name, topic] : by_name) topics_.push_back(topic);
    refuseOtherEncodings(others);
  }

  /// Of what has been read.
  void takeDamage() {
    const std::string& damage = reader_.damage();
    if (damage.empty() || !warnings_.empty()) return;
    if (!keep_going_) throw InputError(damage + "; --keep-going imports what is whole");
    warnings_.push_back(damage + ": what is whole is imported");
  }

  /// Where no image can be read but something else is there, say what.
  void refuseOtherEncodings(const std::map<std::string, std::string>& others) const {
    for (const RosTopic& topic : topics_) {
      const RosKind kind = rosKindOf(topic.type);
      if (kind == RosKind::kImage || kind == RosKind::kCompressedImage) return;
    }
    if (others.empty()) return;
    std::vector<std::string> list;
    for (const auto& [topic, encoding] : others) list.push_back(topic + " (" + encoding + ")");
    throw InputError(
        file_, "holds no images of ROS messages (cdr, ros1); what it has is not read: " + firstTenOf(list));
  }

  std::filesystem::path file_;
  McapReader reader_;
  bool keep_going_;
  std::vector<RosTopic> topics_;
  std::vector<std::string> warnings_;
};

ImportSummary importMcap(const ImportOptions& options, Progress& progress) {
  return importRosRecording(*openMcap(options.source, options.keep_going), options, progress);
}

}  // namespace

std::unique_ptr<RosRecording> openMcap(const std::filesystem::path& file, bool keep_going) {
  return std::make_unique<McapRecording>(file, keep_going);
}

Importer mcapImporter() {
  return rosImporter("mcap", "MCAP, as rosbag2 and Foxglove record it: images, IMU, range, camera_info",
                     "F.mcap", importMcap);
}

}  // namespace redbee
