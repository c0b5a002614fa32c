#include "processes/redbee/vehicle/process_identity.hpp"

#include <unistd.h>

#include <ctime>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

namespace redbee {
namespace {

std::filesystem::path folderOf(pid_t pid) { return "/proc/" + std::to_string(pid); }

/// The fields of proc(5)'s stat from the third on; the name in parentheses may itself hold any character.
std::optional<std::istringstream> statOf(pid_t pid) {
  std::ifstream file(folderOf(pid) / "stat");
  std::string text;
  if (!std::getline(file, text)) return std::nullopt;
  const size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return std::nullopt;
  return std::istringstream(text.substr(name_end + 1));
}

}  // namespace

std::optional<Scheduling> schedulingOf(pid_t pid) {
  auto fields = statOf(pid);
  std::string state;
  int64_t ran_ns = 0;
  std::ifstream schedstat(folderOf(pid) / "schedstat");
  if (!fields || !(*fields >> state) || !(schedstat >> ran_ns) || ran_ns <= 0) return std::nullopt;
  return Scheduling{state == "R", std::chrono::nanoseconds(ran_ns)};
}

std::optional<ProcessIdentity> identityOf(pid_t pid) {
  auto fields = statOf(pid);
  if (!fields) return std::nullopt;
  ProcessIdentity identity;
  std::string field;
  constexpr int kParent = 4;  // proc(5) counts from 1; the name is field 2
  constexpr int kStart = 22;
  for (int number = 3; number <= kStart && *fields >> field; ++number) {
    if (number == kParent) identity.parent = std::stoi(field);
    if (number == kStart) identity.start_ticks = std::stoll(field);
  }
  if (identity.start_ticks == 0) return std::nullopt;
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  const int64_t now_ms = int64_t{1000} * now.tv_sec + now.tv_nsec / 1'000'000;
  identity.age = std::chrono::milliseconds(now_ms - 1000 * identity.start_ticks / sysconf(_SC_CLK_TCK));
  std::error_code error;
  identity.executable = std::filesystem::read_symlink(folderOf(pid) / "exe", error);
  if (error) return std::nullopt;
  return identity;
}

}  // namespace redbee
