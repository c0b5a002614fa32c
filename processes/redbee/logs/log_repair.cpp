#include "processes/redbee/logs/log_repair.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <optional>

#include "redbee/files/input_file.hpp"
#include "redbee/files/log.hpp"
#include "redbee/files/natural_order.hpp"

namespace redbee {
namespace {

/// 12 of F.lcm.0012; std::nullopt where the name ends otherwise.
std::optional<int64_t> numberOf(const std::filesystem::path& part) {
  const std::string extension = part.extension().string();
  constexpr size_t kMostDigits = 9;
  if (extension.size() < 2 || extension.size() > 1 + kMostDigits) return std::nullopt;
  if (extension.find_first_not_of("0123456789", 1) != std::string::npos) return std::nullopt;
  return std::stoll(extension.substr(1));
}

/// Of parts of one log, in their order: what their numbers leave out in between.
std::string missingAmong(const std::vector<std::filesystem::path>& parts) {
  std::vector<std::string> gaps;
  for (size_t k = 1; k < parts.size(); ++k) {
    const auto before = numberOf(parts[k - 1]), number = numberOf(parts[k]);
    if (!before || !number || parts[k - 1].stem() != parts[k].stem()) return "";
    const int64_t first = *before + 1, last = *number - 1;
    if (last < first) continue;
    gaps.push_back(first == last ? fmt::format("{}", first) : fmt::format("{} to {}", first, last));
  }
  if (gaps.empty()) return "";
  const std::string last = gaps.back();
  gaps.pop_back();
  return fmt::format("parts {}{}{} are not among the files: their messages are left out",
                     fmt::join(gaps, ", "), gaps.empty() ? "" : " and ", last);
}

}  // namespace

LogRepair repairLog(std::vector<std::filesystem::path> parts, const std::filesystem::path& out) {
  requireNoInput(out, parts);
  requireNoneTwice(parts);
  std::sort(parts.begin(), parts.end(), isFileNaturallyBefore);
  LogRepair repair;
  repair.missing = missingAmong(parts);
  LogWriter writer(out);
  for (const std::filesystem::path& part : parts) {
    LogReader reader(part);
    while (const auto event = reader.next()) {
      writer.write(event->utime, event->channel, event->data);
      ++repair.messages;
    }
    if (!reader.damageReport().empty()) repair.damage.push_back(reader.damageReport());
  }
  writer.close();
  return repair;
}

}  // namespace redbee
