#include "processes/redbee/rosbag/bag_recording.hpp"

#include <console_bridge/console.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"

namespace redbee {
namespace {

constexpr std::string_view kMagic = "#ROSBAG V";
/// No message is larger; a damaged length may be.
constexpr uint32_t kLargestMessage = 256U << 20;

const char* const kRepair = " (Debian's python3-rosbag, or python3 -m rosbag.rosbag_main)";

void requireMagic(const std::filesystem::path& file) {
  requireFile(file);
  std::array<char, kMagic.size()> bytes{};
  std::ifstream(file, std::ios::binary).read(bytes.data(), bytes.size());
  const std::string_view start(bytes.data(), bytes.size());
  if (start != kMagic)
    throw InputError(file, "is no ROS 1 bag: it does not start with '" + std::string(kMagic) + "'");
}

class BagRecording : public RosRecording {
 public:
  explicit BagRecording(std::filesystem::path file) : file_(std::move(file)) {
    console_bridge::noOutputHandler();  // what it has to say is in the exceptions
    requireMagic(file_);
    attempt([&] {
      bag_.open(file_.string(), rosbag::bagmode::Read);
      listTopics();
    });
  }

  const std::vector<RosTopic>& topics() const override { return topics_; }

  void read(const std::set<std::string>& names,
            const std::function<bool(const RosMessage&)>& on_message) override {
    attempt([&] {
      rosbag::View view(bag_, rosbag::TopicQuery(std::vector<std::string>(names.begin(), names.end())));
      for (const rosbag::MessageInstance& message : view) {
        if (!pass(message, on_message)) break;
      }
    });
  }

 private:
  void listTopics() {
    rosbag::View view(bag_);
    for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
      const bool is_known = std::any_of(topics_.begin(), topics_.end(), [&](const RosTopic& topic) {
        return topic.name == connection->topic;  // of another publisher
      });
      if (!is_known) topics_.push_back({connection->topic, connection->datatype, RosEncoding::kRos1, 0});
    }
    for (RosTopic& topic : topics_) {
      topic.messages = rosbag::View(bag_, rosbag::TopicQuery(topic.name)).size();
    }
  }

  bool pass(const rosbag::MessageInstance& instance,
            const std::function<bool(const RosMessage&)>& on_message) {
    const auto topic = std::find_if(topics_.begin(), topics_.end(),
                                    [&](const RosTopic& t) { return t.name == instance.getTopic(); });
    if (topic == topics_.end() || topic->type != instance.getDataType()) return true;
    const uint32_t size = instance.size();
    if (size > kLargestMessage)
      throw rosbag::BagFormatException("a message of " + std::to_string(size) + " bytes");
    bytes_.resize(size);
    ros::serialization::OStream stream(bytes_.data(), size);
    instance.write(stream);
    const auto logged_ns = static_cast<int64_t>(instance.getTime().toNSec());
    return on_message({&*topic, logged_ns, {bytes_.data(), bytes_.size()}});
  }

  template <typename Work>
  void attempt(const Work& work) const {
    try {
      work();
    } catch (const UserError&) {
      throw;
    } catch (const rosbag::BagUnindexedException&) {
      throw InputError(file_,
                       std::string("has no index, as a bag whose recording was cut short: rosbag reindex "
                                   "writes it") +
                           kRepair);
    } catch (const std::exception& error) {
      std::string line = error.what();
      std::replace(line.begin(), line.end(), '\n', ' ');
      throw InputError(file_, "is damaged: " + line + "; rosbag reindex may save what is whole" + kRepair);
    }
  }

  std::filesystem::path file_;
  rosbag::Bag bag_;
  std::vector<RosTopic> topics_;
  std::vector<uint8_t> bytes_;
};

}  // namespace

std::unique_ptr<RosRecording> openBag(const std::filesystem::path& file) {
  return std::make_unique<BagRecording>(file);
}

}  // namespace redbee
