#include "processes/redbee/vehicle/top.hpp"

#include <curses.h>
#include <spdlog/fmt/fmt.h>

#include <chrono>
#include <clocale>
#include <cstdio>
#include <ctime>
#include <memory>

#include "processes/redbee/vehicle/health_board.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/node/node.hpp"

namespace redbee {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kMinColumns = 80;
constexpr std::chrono::milliseconds kPoll{100};
constexpr std::chrono::seconds kRefresh{1};

struct Receiver {
  std::unique_ptr<Bus> bus;
  Subscription subscription;
};

Receiver listen(const TopOptions& options, HealthBoard& board) {
  auto bus = makeLcmBus(options.url);
  auto subscription = bus->subscribe<process_health_t>(
      options.channel, kListenerQueue,
      [&board](const process_health_t& m) { board.onHealth(m, Clock::now()); });
  return {std::move(bus), std::move(subscription)};
}

std::string headline(const HealthBoard& board, Clock::time_point now) {
  const std::time_t wall = std::time(nullptr);
  std::tm parts{};
  localtime_r(&wall, &parts);
  return fmt::format("redbee top - {:02}:{:02}:{:02}, {} processes, {} good", parts.tm_hour, parts.tm_min,
                     parts.tm_sec, board.processes(), board.good(now));
}

/// Restores the terminal on destruction.
class Screen {
 public:
  Screen() {
    std::setlocale(LC_ALL, "");
    initscr();
    cbreak();
    noecho();
    curs_set(0);
    nodelay(stdscr, TRUE);
    keypad(stdscr, TRUE);
    if (has_colors() == FALSE) return;
    start_color();
    use_default_colors();
    init_pair(kGoodPair, COLOR_GREEN, -1);
    init_pair(kWarningPair, COLOR_YELLOW, -1);
    init_pair(kBadPair, COLOR_RED, -1);
  }
  ~Screen() { endwin(); }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  void show(const HealthBoard& board, const std::string& url) const {
    const auto now = Clock::now();
    erase();
    print(0, {headline(board, now)});
    print(1, {url});
    int y = 3;
    for (const BoardLine& line : board.table(now, std::max(COLS, kMinColumns))) print(y++, line);
    if (board.processes() == 0) print(y, {"no messages yet; redbee doctor checks for the cause"});
    print(LINES - 1, {"q: quit   MED, P99ms: from frame to answer   DMGD: messages not decoded"});
    refresh();
  }

 private:
  static constexpr short kGoodPair = 1;
  static constexpr short kWarningPair = 2;
  static constexpr short kBadPair = 3;

  static attr_t attributes(Tone tone) {
    switch (tone) {
      case Tone::kHeading:
        return A_REVERSE;
      case Tone::kGood:
        return COLOR_PAIR(kGoodPair);
      case Tone::kWarning:
        return COLOR_PAIR(kWarningPair) | A_BOLD;
      case Tone::kBad:
        return COLOR_PAIR(kBadPair) | A_BOLD;
      case Tone::kPlain:
        break;
    }
    return A_NORMAL;
  }

  static void print(int y, const BoardLine& line) {
    attrset(attributes(line.tone));
    mvaddnstr(y, 0, line.text.c_str(), COLS);
    attrset(A_NORMAL);
  }
};

void showOnce(const TopOptions& options, HealthBoard& board) {
  const Receiver receiver = listen(options, board);
  const auto end = Clock::now() + std::chrono::duration<double>(options.listen_s);
  while (Clock::now() < end) receiver.bus->handle(kPoll);
  std::printf("%s\n", headline(board, Clock::now()).c_str());
  for (const BoardLine& line : board.table(Clock::now())) std::printf("%s\n", line.text.c_str());
}

void showUntilQuit(const TopOptions& options, HealthBoard& board) {
  const Receiver receiver =
      listen(options, board);  // before the screen: LCM's messages belong on a plain terminal
  const std::atomic<bool>& stop = stopOnSignals();
  const Screen screen;
  auto next = Clock::now();
  while (!stop) {
    const bool received = receiver.bus->handle(kPoll) > 0;
    const int key = getch();
    if (key == 'q' || key == 'Q') return;
    if (!received && key == ERR && Clock::now() < next) continue;
    screen.show(board, options.url);
    next = Clock::now() + kRefresh;
  }
}

}  // namespace

int runTop(const TopOptions& options) {
  HealthBoard board;
  if (options.once) {
    showOnce(options, board);
  } else {
    showUntilQuit(options, board);
  }
  return board.processes();
}

}  // namespace redbee
