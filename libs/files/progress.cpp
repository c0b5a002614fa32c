#include "redbee/files/progress.hpp"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

namespace redbee {
namespace {

constexpr std::chrono::milliseconds kSilence{1000};
constexpr std::chrono::milliseconds kTerminalPeriod{100};
constexpr std::chrono::milliseconds kPlainPeriod{3000};

}  // namespace

Progress::Progress(std::string what, std::string unit, bool quiet)
    : what_(std::move(what)),
      unit_(std::move(unit)),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      next_(start_ + kSilence) {}

Progress::~Progress() { finish(); }

void Progress::update(int64_t done, int64_t total) {
  done_ = done;
  total_ = total;
  const auto now = Clock::now();
  if (quiet_ || now < next_) return;
  next_ = now + (terminal_ ? kTerminalPeriod : kPlainPeriod);
  shown_ = true;
  std::fprintf(stderr, terminal_ ? "\r%s\033[K" : "%s\n", line().c_str());
  std::fflush(stderr);
}

void Progress::finish() {
  if (!shown_) return;
  shown_ = false;
  std::fprintf(stderr, terminal_ ? "\r%s\033[K\n" : "%s\n", line().c_str());
}

std::string Progress::line() const {
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  if (total_ <= 0) return fmt::format("{}: {} {}, {:.1f} s", what_, done_, unit_, seconds);
  const double percent = 100.0 * static_cast<double>(done_) / static_cast<double>(total_);
  return fmt::format("{}: {} of {} {} ({:.0f} %), {:.1f} s", what_, done_, total_, unit_, percent, seconds);
}

}  // namespace redbee
