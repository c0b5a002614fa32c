#include "processes/redbee/logs/log_survey.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <ctime>
#include <vector>

#include "processes/redbee/pages/table.hpp"
#include "redbee/bus/codec.hpp"
#include "redbee/bus/message_name.hpp"
#include "redbee/bus/raw_format.hpp"
#include "redbee/files/log.hpp"

namespace redbee {
namespace {

template <typename... Messages>
bool decodesAsOneOf(const std::vector<uint8_t>& data, TypeList<Messages...>) {
  const auto decodes = [&](auto message) {
    return decodeMessage(data.data(), static_cast<int>(data.size()), message);
  };
  return (decodes(Messages{}) || ...);
}

/// Of images also size and pixel format.
std::string typeOf(const std::vector<uint8_t>& data) {
  std::string name = messageName(data);
  if (name.empty()) return messageHash(data).empty() ? "no message" : messageHash(data);
  image_t image;
  if (!decodeMessage(data.data(), static_cast<int>(data.size()), image)) return name;
  return fmt::format("{} {}x{} {}", name, image.width, image.height, formatName(image.pixelformat));
}

void add(const LogEvent& event, ChannelSurvey& channel) {
  const std::string name = messageName(event.data);
  if (channel.messages == 0) {
    channel.type = typeOf(event.data);
    channel.first_utime = channel.last_utime = event.utime;
  } else if (name != channel.type.substr(0, channel.type.find(' ')) &&
             messageHash(event.data) != channel.type) {
    ++channel.other_types;
  }
  if (!name.empty() && !decodesAsOneOf(event.data, MessageTypes{})) ++channel.damaged;
  channel.longest_gap_us = std::max(channel.longest_gap_us, event.utime - channel.last_utime);
  channel.first_utime = std::min(channel.first_utime, event.utime);
  channel.last_utime = std::max(channel.last_utime, event.utime);
  channel.bytes += static_cast<int64_t>(event.data.size());
  ++channel.messages;
}

double inSeconds(int64_t us) { return 1e-6 * static_cast<double>(us); }

/// With the date, where the times are of the Unix clock.
std::string startText(int64_t utime) {
  constexpr int64_t kYear2000 = 946'684'800'000'000;
  std::string text = fmt::format("{:.6f} s", inSeconds(utime));
  if (utime < kYear2000) return text;
  const std::time_t whole = utime / 1'000'000;
  std::tm calendar{};
  char date[32] = {};
  if (gmtime_r(&whole, &calendar) == nullptr ||
      std::strftime(date, sizeof date, "%Y-%m-%d %H:%M:%S UTC", &calendar) == 0)
    return text;
  return text + " (" + date + ")";
}

std::string faultsOf(const ChannelSurvey& channel) {
  std::string text;
  if (channel.damaged > 0) text += fmt::format("{} damaged", channel.damaged);
  if (channel.other_types > 0)
    text += fmt::format("{}{} of another type", text.empty() ? "" : ", ", channel.other_types);
  return text.empty() ? "-" : text;
}

std::string damageText(const LogSurvey& survey) {
  if (survey.damage_report.empty()) return "none";
  std::string text;
  if (survey.damaged > 0)
    text = fmt::format("{} place{} skipped, ", survey.damaged, survey.damaged == 1 ? "" : "s");
  if (survey.truncated) text += "the end is cut short, ";
  return text + "first: " + survey.damage_report;
}

}  // namespace

double ChannelSurvey::rate() const {
  return messages < 2 || last_utime <= first_utime
             ? 0
             : static_cast<double>(messages - 1) / inSeconds(last_utime - first_utime);
}

int64_t LogSurvey::messages() const {
  int64_t sum = 0;
  for (const auto& [name, channel] : channels) sum += channel.messages;
  return sum;
}

LogSurvey surveyLog(const std::filesystem::path& log) {
  LogReader reader(log);
  LogSurvey survey;
  while (const auto event = reader.next()) add(*event, survey.channels[event->channel]);
  survey.bytes = reader.size();
  survey.damaged = reader.damaged();
  survey.truncated = reader.truncated();
  survey.damage_report = reader.damageReport();
  return survey;
}

std::string asText(const LogSurvey& survey, const std::filesystem::path& log) {
  int64_t first = 0, last = 0;
  bool any = false;
  Table table;
  table.columns = {"channel", "type", "messages", "Hz", "longest gap ms", "from s", "to s", "MB", "faults"};
  table.text_columns = {0, 1, 8};
  for (const auto& [name, channel] : survey.channels) {
    first = any ? std::min(first, channel.first_utime) : channel.first_utime;
    last = any ? std::max(last, channel.last_utime) : channel.last_utime;
    any = true;
  }
  for (const auto& [name, channel] : survey.channels) {
    table.rows.push_back({printable(name), printable(channel.type), std::to_string(channel.messages),
                          fmt::format("{:.2f}", channel.rate()),
                          fmt::format("{:.1f}", 1e-3 * static_cast<double>(channel.longest_gap_us)),
                          fmt::format("{:.3f}", inSeconds(channel.first_utime - first)),
                          fmt::format("{:.3f}", inSeconds(channel.last_utime - first)),
                          fmt::format("{:.2f}", 1e-6 * static_cast<double>(channel.bytes)),
                          faultsOf(channel)});
  }
  return fmt::format(
             "log:      {} ({:.2f} MB)\nstart:    {}\nduration: {:.3f} s\nmessages: {}\ndamage:   {}\n",
             log.string(), 1e-6 * static_cast<double>(survey.bytes), startText(first),
             inSeconds(last - first), survey.messages(), damageText(survey)) +
         asText(table);
}

}  // namespace redbee
