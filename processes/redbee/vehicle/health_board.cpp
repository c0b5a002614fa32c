#include "processes/redbee/vehicle/health_board.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>

#include "processes/health_check.hpp"
#include "processes/redbee/vehicle/watch.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/node/health.hpp"

namespace redbee {
namespace {

/// Process, state, process id and eight figures.
constexpr const char* kRow = "{:<19.19} {:<9.9}{:>7} {:>5} {:>5} {:>5} {:>5} {:>4} {:>4} {:>4} {:>4}";

std::string shortName(const std::string& process) {
  const std::string prefix = "redbee-";
  return process.rfind(prefix, 0) == 0 ? process.substr(prefix.size()) : process;
}

/// At most four characters, whatever the count.
std::string brief(int64_t count) {
  if (count < 10000) return std::to_string(count);
  if (count < 1000000) return fmt::format("{}k", count / 1000);
  return fmt::format("{}M", std::min(count / 1000000, int64_t{999}));
}

/// At most five characters.
std::string brief(double value) {
  if (value < 1000) return fmt::format("{:.1f}", value);
  return value < 99999 ? fmt::format("{:.0f}", value) : ">99 s";
}

long long secondsBetween(HealthBoard::Time from, HealthBoard::Time to) {
  return std::chrono::duration_cast<std::chrono::seconds>(to - from).count();
}

Tone toneOf(HealthState state) {
  switch (state) {
    case HealthState::kGood:
      return Tone::kGood;
    case HealthState::kStarting:
    case HealthState::kDegraded:
    case HealthState::kStopping:
      return Tone::kWarning;
    case HealthState::kDead:
      return Tone::kBad;
  }
  return Tone::kBad;
}

/// Ended in order, as a recorder is by the one who started it; a process that should fly is missed all the
/// same.
bool hasStopped(const process_health_t& health) {
  return health.state == static_cast<int8_t>(HealthState::kDead) && health.message.rfind(kStopped, 0) == 0;
}

Tone toneOf(const process_health_t& health) {
  if (!hasStopped(health)) return toneOf(static_cast<HealthState>(health.state));
  return health.process == programName(kRecord) ? Tone::kPlain : Tone::kWarning;
}

/// The stages in processing order, with or without messages, then others that publish, such as drivers, by
/// name.
template <typename Entries>
std::vector<std::string> inOrderOfWork(const Entries& entries) {
  std::vector<std::string> names;
  names.reserve(kStages.size() + entries.size());
  for (const auto* stage : kStages) names.push_back(programName(*stage));
  for (const auto& [name, entry] : entries) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

/// Control characters from the network must not reach a terminal.
std::string withoutControls(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return text;
}

/// What does not fit goes on in the next line, indented: a message's end says what to do.
void appendWrapped(std::vector<BoardLine>& lines, const BoardLine& line, size_t columns) {
  const std::string indent = "  ";
  std::string rest = line.text;
  while (rest.size() > columns) {
    const size_t space = rest.rfind(' ', columns);
    const bool is_between_words = space != std::string::npos && space > indent.size();
    lines.push_back({rest.substr(0, is_between_words ? space : columns), line.tone});
    rest.replace(0, is_between_words ? space + 1 : columns, indent);
  }
  lines.push_back({rest, line.tone});
}

}  // namespace

void HealthBoard::onHealth(const process_health_t& health, Time now) {
  if (!isKnownProcess(health.process)) {
    ++strangers_;
    return;
  }
  if (!isPlausible(health)) {
    ++implausible_;
    return;
  }
  const auto [it, is_new] = entries_.try_emplace(health.process);
  Entry& entry = it->second;
  if (!is_new && health.pid != entry.last.pid) {
    ++entry.restarts;
    entry.restarted = now;
  }
  entry.last = health;
  entry.received = now;
}

bool HealthBoard::isSilent(const Entry& entry, Time now) {
  const bool is_over = entry.last.state == static_cast<int8_t>(HealthState::kDead) ||
                       entry.last.state == static_cast<int8_t>(HealthState::kStopping);
  const bool is_script = entry.last.configuration.empty();  // publishes only when its state changes
  return !is_over && !is_script && now - entry.received > kSilence;
}

int HealthBoard::good(Time now) const {
  return static_cast<int>(std::count_if(entries_.begin(), entries_.end(), [&](const auto& named) {
    return !isSilent(named.second, now) && named.second.last.state == static_cast<int8_t>(HealthState::kGood);
  }));
}

BoardLine HealthBoard::row(const Process& process) {
  if (!process.last) return {fmt::format("{:<19} no messages", process.name), process.tone};
  const process_health_t& h = *process.last;
  // A space separates columns even if a cell is full.
  return {fmt::format(kRow, process.name, process.state, h.pid, brief(h.rate_in), brief(h.rate_out),
                      brief(h.latency_median), brief(h.latency_p99), brief(h.skipped), brief(h.lost),
                      brief(h.damaged), brief(h.resident >> 20)),
          process.tone};
}

void HealthBoard::appendRemarks(std::vector<BoardLine>& lines, Time now) const {
  for (const std::string& name : inOrderOfWork(entries_)) {
    const auto it = entries_.find(name);
    if (it == entries_.end()) continue;
    const Entry& entry = it->second;
    const std::string who = shortName(name) + ": ";
    if (isSilent(entry, now)) {
      lines.push_back(
          {who + fmt::format("silent since {} s", secondsBetween(entry.received, now)), Tone::kBad});
    }
    if (!entry.last.message.empty()) {
      lines.push_back({who + entry.last.message, toneOf(entry.last)});
    }
    if (entry.last.calibration.rfind("does not", 0) == 0) {
      lines.push_back({who + "calibration: " + entry.last.calibration, Tone::kWarning});
    }
    if (entry.last.late > 0) {
      lines.push_back({who + fmt::format("{} inputs timed out", entry.last.late), Tone::kPlain});
    }
    if (entry.restarts > 0) {
      lines.push_back({who + fmt::format("restarts seen: {}, the last {} s ago", entry.restarts,
                                         secondsBetween(entry.restarted, now)),
                       Tone::kPlain});
    }
  }
}

/// Warns of processes with different builds or configurations.
void HealthBoard::appendBuilds(std::vector<BoardLine>& lines) const {
  std::map<std::string, std::set<std::string>> processes_of;
  for (const auto& [name, entry] : entries_) {
    if (entry.last.configuration.empty()) continue;
    processes_of["version " + entry.last.version + ", configuration " + entry.last.configuration].insert(
        shortName(name));
  }
  for (const auto& [build, processes] : processes_of) {
    std::string line = build;
    if (processes_of.size() > 1) {
      line += ":";
      for (const std::string& process : processes) line += " " + process;
    }
    lines.push_back({line, processes_of.size() > 1 ? Tone::kWarning : Tone::kPlain});
  }
}

std::vector<HealthBoard::Process> HealthBoard::list(Time now) const {
  std::vector<Process> processes;
  for (const std::string& name : inOrderOfWork(entries_)) {
    const auto it = entries_.find(name);
    Process process{shortName(name), "no messages", Tone::kBad, std::nullopt, 0, 0};
    if (it != entries_.end()) {
      const Entry& entry = it->second;
      const char* state =
          hasStopped(entry.last) ? "stopped" : toString(static_cast<HealthState>(entry.last.state));
      const bool silent = isSilent(entry, now);
      process = {shortName(name),
                 silent ? "silent" : state,
                 silent ? Tone::kBad : toneOf(entry.last),
                 entry.last,
                 std::chrono::duration<double>(now - entry.received).count(),
                 entry.restarts};
    }
    processes.push_back(std::move(process));
  }
  return processes;
}

std::vector<BoardLine> HealthBoard::table(Time now, int columns) const {
  std::vector<BoardLine> lines;
  lines.push_back({fmt::format(kRow, "PROCESS", "STATE", "PID", "IN/s", "OUT/s", "MED", "P99ms", "SKIP",
                               "LOST", "DMGD", "MiB"),
                   Tone::kHeading});
  for (const Process& process : list(now)) lines.push_back(row(process));
  const size_t rows = lines.size();
  lines.push_back({"", Tone::kPlain});
  appendRemarks(lines, now);
  appendBuilds(lines);
  const auto count = [&](int64_t messages, const char* of) {
    if (messages > 0) lines.push_back({brief(messages) + " messages " + of, Tone::kWarning});
  };
  count(strangers_, "of names outside the process table: not shown");
  count(implausible_, "that no process can have sent: not shown");
  const auto width = static_cast<size_t>(columns);
  std::vector<BoardLine> shown;
  for (BoardLine& line : lines) {
    line.text = withoutControls(line.text);
    if (shown.size() < rows) line.text = line.text.substr(0, width);
    appendWrapped(shown, line, width);
  }
  return shown;
}

}  // namespace redbee
