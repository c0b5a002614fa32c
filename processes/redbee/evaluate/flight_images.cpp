#include "processes/redbee/evaluate/flight_images.hpp"

#include <algorithm>

#include "redbee/files/input_error.hpp"
#include "redbee/files/log.hpp"
#include "redbee/node/message_check.hpp"

namespace redbee {

void forEachImage(const std::filesystem::path& log_file, const std::string& channel,
                  const std::function<void(const image_t& message)>& take) {
  LogReader log(log_file);
  while (const auto event = log.next()) {
    image_t message;
    if (event->channel == channel && decodePlausible(event->data, message)) take(message);
  }
}

std::vector<int64_t> imageTimes(const std::filesystem::path& log, const std::string& channel) {
  std::vector<int64_t> times;
  forEachImage(log, channel, [&](const image_t& message) { times.push_back(message.utime); });
  if (times.empty()) throw InputError(log, "holds no message on " + channel);
  std::sort(times.begin(), times.end());
  return times;
}

}  // namespace redbee
