// capture_trial: observes a stack whose camera and autopilot are played by tests/capture/player.js, kills one
// process a round, and compares the masks with those of a replay of the log. Exit status 1 if a requirement
// is not met, 77 if the machine is too slow for the flight.
#include <signal.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "processes/common_options.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/files/log.hpp"
#include "tests/capture/captured_rounds.hpp"

namespace redbee::test {
namespace {

namespace fs = std::filesystem;

constexpr int kKillAtFrame = 40;            ///< of the round: after learning, with two thirds of it to come
constexpr double kMostErrorApart = 0.02;    ///< of Error@50%, pooled over all rounds
constexpr double kFewestUndisturbed = 0.5;  ///< of the frames; with fewer masks the machine is too slow
constexpr int kFewestAfterKill = 24;        ///< masks: the stack works again

struct Options {
  std::string url;
  fs::path log, labels, replay, sent, extract;
  int player = 0;
  bool print_rounds = false;
};

std::vector<std::string> victims() {
  std::vector<std::string> programs{programName(kCamera), programName(kAutopilot)};
  for (const ProcessDescription* stage : kStages) programs.push_back(programName(*stage));
  return programs;
}

std::vector<image_t> imagesOf(const fs::path& log) {
  LogReader reader(log);
  std::vector<image_t> images;
  while (const auto event = reader.next()) {
    if (event->channel != "CAMERA") continue;
    images.emplace_back();
    images.back().decode(event->data.data(), 0, static_cast<int>(event->data.size()));
  }
  return images;
}

void extract(const Options& options) {
  int number = 0;
  for (const image_t& image : imagesOf(options.log)) {
    char name[16];
    std::snprintf(name, sizeof name, "%03d.jpg", number++);
    std::ofstream(options.extract / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(image.data.data()), image.size);
  }
}

class Trial {
 public:
  explicit Trial(const Options& options)
      : options_(options), bus_(makeLcmBus(options.url)), rounds_(*bus_, imagesOf(options.log)) {}

  int run() {
    const auto victim = victims();
    while (::kill(options_.player, 0) == 0) {
      bus_->handle(std::chrono::milliseconds(20));
      rounds_.readSent(options_.sent);
      const SentFrame now = rounds_.newest();
      if (now.round != killed_in_round_ + 1 || now.round == 0 || now.frame < kKillAtFrame) continue;
      if (!kill(victim.at(static_cast<size_t>(now.round) - 1), now)) return 1;
    }
    return judge(victim);
  }

 private:
  bool kill(const std::string& program, const SentFrame& now) {
    killed_in_round_ = now.round;
    const int pid = rounds_.newestPid(program);
    if (pid > 0 && ::kill(pid, SIGKILL) == 0) return true;
    std::printf("FAILED: %s was not running in round %d\n", program.c_str(), now.round);
    return false;
  }

  int judge(const std::vector<std::string>& victim) {
    rounds_.printTimes();
    rounds_.printLoss();
    const int rounds = static_cast<int>(victim.size()) + 1;
    bool good = true;
    for (int round = 0; round < rounds; ++round) {
      const RoundMeasures m = rounds_.measure({round}, RunFolder(options_.replay), options_.labels);
      const std::string name = round == 0 ? "none" : victim[static_cast<size_t>(round) - 1];
      const int after = rounds_.masksAfter(round, kKillAtFrame);
      std::printf("killed %-26s masks of %3d of %d frames, %3d after it, Error@50%% %.3f, replay %.3f\n",
                  name.c_str(), m.masks, m.frames, after, m.captured.errorAtHalfRecall(),
                  m.replayed.errorAtHalfRecall());
      if (round == 0 && m.masks < kFewestUndisturbed * m.frames) return tooSlow();
      if (round > 0 && after < kFewestAfterKill) good = fails(name + ": no masks after the kill");
      if (round > 0 && rounds_.lives(name) < 2) good = fails(name + " did not come back");
    }
    std::vector<int> all(static_cast<size_t>(rounds));
    for (int round = 0; round < rounds; ++round) all[static_cast<size_t>(round)] = round;
    const RoundMeasures m = rounds_.measure(all, RunFolder(options_.replay), options_.labels);
    const double apart = m.captured.errorAtHalfRecall() - m.replayed.errorAtHalfRecall();
    std::printf("all rounds: masks of %d of %d frames, Error@50%% %.3f, replay %.3f over the same frames\n",
                m.masks, m.frames, m.captured.errorAtHalfRecall(), m.replayed.errorAtHalfRecall());
    if (std::abs(apart) > kMostErrorApart) good = fails("Error@50% is another than the replay's");
    return good ? 0 : 1;
  }

  static bool fails(const std::string& what) {
    std::printf("FAILED: %s\n", what.c_str());
    return false;
  }
  static int tooSlow() {
    std::printf("this machine is too slow: it has no time for half of the frames\n");
    return 77;
  }

  Options options_;
  std::unique_ptr<Bus> bus_;
  CapturedRounds rounds_;
  int killed_in_round_ = 0;
};

}  // namespace
}  // namespace redbee::test

// For tests: an exception ends it with its message. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  CLI::App app("compares the masks of a captured flight with those of its replay", "capture_trial");
  redbee::test::Options options;
  redbee::addLcmUrlOption(app, options.url);
  app.add_option("--log", options.log);
  app.add_option("--labels", options.labels);
  app.add_option("--replay", options.replay);
  app.add_option("--sent", options.sent);
  app.add_option("--player", options.player, "its process");
  app.add_option("--extract", options.extract, "write the log's JPEG files there and end");
  app.add_flag("--print-rounds", options.print_rounds, "print how many rounds the trial takes and end");
  CLI11_PARSE(app, argc, argv);
  if (options.print_rounds) return std::printf("%zu\n", redbee::test::victims().size() + 1) > 0 ? 0 : 1;
  if (!options.extract.empty()) {
    redbee::test::extract(options);
    return 0;
  }
  return redbee::test::Trial(options).run();
}
