#include "processes/redbee/logs/log_repair.hpp"

#include <algorithm>

#include "redbee/files/input_file.hpp"
#include "redbee/files/log.hpp"
#include "redbee/files/natural_order.hpp"

namespace redbee {

LogRepair repairLog(std::vector<std::filesystem::path> parts, const std::filesystem::path& out) {
  requireNoInput(out, parts);
  std::sort(parts.begin(), parts.end(), isFileNaturallyBefore);
  LogRepair repair;
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
