#include "processes/redbee/detect/input_survey.hpp"

#include <algorithm>

#include "redbee/bus/image.hpp"
#include "redbee/bus/message_name.hpp"
#include "redbee/node/message_check.hpp"

namespace redbee {

void InputSurvey::Span::add(int64_t utime) {
  first_utime = count == 0 ? utime : std::min(first_utime, utime);
  last_utime = count == 0 ? utime : std::max(last_utime, utime);
  ++count;
}

void InputSurvey::add(const LogEvent& event) {
  if (event.channel == configuration_.channels.camera) {
    image_t image;
    const bool is_image = decodePlausible(event.data, image);
    camera_.add(is_image ? image.utime : event.utime);
    if (camera_.count == 1) first_image_ = event.data;
  } else if (event.channel == configuration_.channels.imu) {
    ins_t sample;
    imu_.add(decodePlausible(event.data, sample) ? sample.utime : event.utime);
  }
}

std::vector<std::string> InputSurvey::warnings() const {
  const std::string& channel = configuration_.channels.imu;
  std::vector<std::string> lines;
  if (configuration_.has_imu && imu_.count == 0) {
    lines.push_back("imu.present is true, but the log holds no message on " + channel +
                    ": set imu.present: false");
  } else if (!configuration_.has_imu && imu_.count > 0) {
    lines.push_back("imu.present is false: the " + std::to_string(imu_.count) + " messages on " + channel +
                    " are not used");
  } else if (imu_.count > 0 &&
             (imu_.first_utime > camera_.last_utime || imu_.last_utime < camera_.first_utime)) {
    lines.push_back("the messages on " + channel + " cover none of the images: their times are " +
                    std::to_string(imu_.first_utime) + " to " + std::to_string(imu_.last_utime) +
                    " us, the images' " + std::to_string(camera_.first_utime) + " to " +
                    std::to_string(camera_.last_utime) + " us: check their clocks");
  }
  return lines;
}

std::string InputSurvey::faultOfFirstImage() const {
  const std::string& channel = configuration_.channels.camera;
  const std::string name = messageName(first_image_);
  if (name.empty())
    return channel + " holds messages of an unknown type, " + messageHash(first_image_) + ", not image_t";
  if (name != image_t::getTypeName()) return channel + " holds " + name + ", not image_t";
  image_t image;
  if (!decodeMessage(first_image_.data(), static_cast<int>(first_image_.size()), image))
    return channel + ": the message is damaged";
  if (!isPlausible(image)) return channel + ": implausible " + faultOf(image);
  return faultOfImage(image);
}

}  // namespace redbee
