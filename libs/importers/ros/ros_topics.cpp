#include "redbee/importers/ros/ros_topics.hpp"

#include <algorithm>
#include <set>

#include "redbee/files/input_error.hpp"
#include "redbee/files/printable.hpp"
#include "redbee/importers/ros/ros_messages.hpp"

namespace redbee {
namespace {

using Topics = std::vector<RosTopic>;

struct TopicRole {
  std::set<RosKind> kinds;
  const char* what;
  const char* option;
};

std::string listed(const Topics& topics) {
  std::vector<std::string> names;
  for (const RosTopic& topic : topics)
    names.push_back(topic.name + " (" + std::to_string(topic.messages) + " " + topic.type + ")");
  return names.empty() ? "none" : firstTenOf(names);
}

std::optional<RosTopic> choose(const Topics& topics, const std::string& chosen, const TopicRole& role,
                               const std::filesystem::path& file) {
  if (chosen == "none") return std::nullopt;
  Topics candidates;
  std::copy_if(topics.begin(), topics.end(), std::back_inserter(candidates), [&](const RosTopic& topic) {
    return role.kinds.count(rosKindOf(topic.type)) > 0 && topic.messages > 0;
  });
  if (!chosen.empty()) {
    const auto found = std::find_if(candidates.begin(), candidates.end(),
                                    [&](const RosTopic& topic) { return topic.name == chosen; });
    if (found != candidates.end()) return *found;
    throw InputError(file, "holds no " + std::string(role.what) + " on " + chosen + " (" + role.option +
                               "); it has " + listed(candidates));
  }
  if (candidates.empty()) return std::nullopt;
  if (candidates.size() == 1) return candidates.front();
  throw InputError(file, "has several topics with " + std::string(role.what) + ": choose one with " +
                             role.option + ": " + listed(candidates));
}

/// camera_info beside the image, or beside the image that this one was compressed from.
std::string cameraInfoOf(const std::string& image, const Topics& topics) {
  for (std::string space = image; !space.empty();) {
    space.erase(space.find_last_of('/') == std::string::npos ? 0 : space.find_last_of('/'));
    for (const RosTopic& topic : topics) {
      const bool is_info = rosKindOf(topic.type) == RosKind::kCameraInfo && topic.messages > 0;
      if (is_info && topic.name == space + "/camera_info") return topic.name;
    }
  }
  return "";
}

}  // namespace

RosTopics chooseRosTopics(const Topics& topics, const RosTopicChoice& choice,
                          const std::filesystem::path& file) {
  const auto image = choose(topics, choice.image,
                            {{RosKind::kImage, RosKind::kCompressedImage}, "images", "--image-topic"}, file);
  if (!image)
    throw InputError(file,
                     "holds no images (sensor_msgs Image or CompressedImage); it has " + listed(topics));
  RosTopics chosen{*image, {}, {}, {}};
  chosen.imu = choose(topics, choice.imu, {{RosKind::kImu}, "an IMU", "--imu-topic"}, file);
  chosen.range = choose(topics, choice.range, {{RosKind::kRange}, "a range", "--range-topic"}, file);
  const std::string info =
      choice.camera_info.empty() ? cameraInfoOf(image->name, topics) : choice.camera_info;
  chosen.camera_info =
      choose(topics, info, {{RosKind::kCameraInfo}, "a camera_info", "--camera-info-topic"}, file);
  return chosen;
}

}  // namespace redbee
