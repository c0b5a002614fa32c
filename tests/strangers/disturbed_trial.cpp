// disturbed_trial: publishes the endless flight to a running stack, disturbs it, and compares the output with
// the truth: one line a disturbance. Exit status 1 where a mask is wild, too few frames are trusted, or a
// process was started again; 3 where too few are trusted on a machine that was too slow to tell: it skips as
// many frames when the stranger sends the same where nobody listens, or the relay loses nothing. With
// --relay, the stack's processes have the LCM groups that are given, and everything passes through a lossy
// relay.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "processes/common_options.hpp"
#include "tests/strangers/disturbance.hpp"
#include "tests/strangers/live_relay.hpp"
#include "tests/strangers/unheard_bus.hpp"
#include "tests/support/live_trial.hpp"
#include "tests/support/trusted_frames.hpp"

namespace redbee::test {
namespace {

constexpr double kLastAnswer_s = 1.5;  ///< after a phase
/// Of the frames. More of them skipped, and the gaps cost others their trust as well.
constexpr double kSlowMachine = 0.02;
/// Of a phase and the same without its effect, before what skips only in the first is the disturbance's
/// doing: what else runs on the machine comes and goes.
constexpr int kAttempts = 3;

enum class Outcome { kPassed = 0, kFailed = 1, kTooSlow = 3 };

struct Options {
  std::string url;
  std::vector<std::string> disturbances = {"none"};
  double seconds = 6;
  double speed = 1;
  double least = 0.95;  ///< of the frames whose image arrived
  std::vector<std::string> relay;
  RelayFaults faults;
};

class Trial : LiveTrial {
 public:
  explicit Trial(const Options& options)
      : LiveTrial(options.url,
                  kLongestPause_s + static_cast<double>(options.disturbances.size()) * 2 * kAttempts *
                                        (options.seconds + kLastAnswer_s),
                  options.speed),
        options_(options) {
    hugeImage();  // before the flight, which must not wait for it
    if (options.relay.empty()) return;
    std::vector<std::string> urls = {options.url};
    urls.insert(urls.end(), options.relay.begin(), options.relay.end());
    relay_.emplace(urls, options.faults, options.speed);
  }

  Outcome fly() {
    if (!settle()) return Outcome::kTooSlow;
    bool good = true, in_time = true;
    for (const std::string& name : options_.disturbances) {
      const Outcome outcome = disturb(name);
      good = good && outcome != Outcome::kFailed;
      in_time = in_time && outcome != Outcome::kTooSlow;
    }
    for (const std::string& process : programs()) good = hasLived(observer(), process, 1) && good;
    return !good ? Outcome::kFailed : in_time ? Outcome::kPassed : Outcome::kTooSlow;
  }

 private:
  struct Phase {
    TrustedFrames frames;
    int64_t skipped = 0;

    bool isSlow() const { return static_cast<double>(skipped) > kSlowMachine * frames.expected; }
  };

  Outcome disturb(const std::string& name) {
    for (int attempt = 1;; ++attempt) {
      const Phase disturbed = flyPhase(name, true);
      if (disturbed.frames.wild > 0) return fail("wild masks"), Outcome::kFailed;
      if (disturbed.frames.trusted >= options_.least * disturbed.frames.expected) return Outcome::kPassed;
      if (!disturbed.isSlow()) return fail("too few trusted frames"), Outcome::kFailed;
      if ((name == "none" && !relay_) || flyPhase(name, false).isSlow()) return Outcome::kTooSlow;
      if (attempt == kAttempts)
        return fail("too few trusted frames, for all of which there is time without it"), Outcome::kFailed;
    }
  }

  /// `heard`: false: the stranger sends where nobody listens, the relay loses nothing.
  Phase flyPhase(const std::string& name, bool heard) {
    if (relay_) relay_->setFaults(heard ? options_.faults : RelayFaults());
    const int64_t first = player().frames();
    const int64_t skipped = framesSkipped();
    {
      std::unique_ptr<Bus> bus;
      if (heard) {
        bus = makeLcmBus(options_.url);
      } else {
        bus = std::make_unique<UnheardBus>(options_.url);
      }
      const Stranger stranger(std::move(bus), name, flight());
      runFor(options_.seconds);
    }
    const int64_t last = player().frames();
    runFor(kLastAnswer_s);
    const Phase phase = {compare(first, last), framesSkipped() - skipped};
    phase.frames.print((heard ? name : "  without effect: " + name).c_str());
    if (phase.skipped > 0)
      std::printf("  and %lld skipped for want of time\n", static_cast<long long>(phase.skipped));
    return phase;
  }

  TrustedFrames compare(int64_t first, int64_t last) const {
    const std::set<int64_t> without_image = relay_ ? relay_->imagesLost() : std::set<int64_t>();
    TrustedFrames frames;
    for (int64_t k = first; k < last; ++k) {
      if (without_image.count(flight().utime(k)) > 0) continue;
      ++frames.expected;
      const auto it = observer().frames().find(flight().utime(k));
      if (it == observer().frames().end() || it->second.status != 0) continue;
      ++frames.trusted;
      frames.wild += it->second.false_fraction > kWildFraction ? 1 : 0;
    }
    return frames;
  }

  /// By the segmentation, which skips what vision skips.
  int64_t framesSkipped() const {
    const auto health = observer().health().find(programName(kMotionSegmentation));
    return health == observer().health().end() ? 0 : health->second.skipped;
  }

  Options options_;
  std::optional<LiveRelay> relay_;
};

}  // namespace
}  // namespace redbee::test

// For tests: an exception ends it with its message. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  CLI::App app("flies into a running stack and disturbs it");
  redbee::test::Options options;
  redbee::addLcmUrlOption(app, options.url);
  app.add_option("--disturb", options.disturbances, "one after the other, by name")->delimiter(',');
  app.add_option("--seconds", options.seconds, "of flight, for each disturbance");
  app.add_option("--speed", options.speed, "times the flight's own speed");
  app.add_option("--least", options.least, "of the frames whose image arrived, that are trusted");
  app.add_option("--relay", options.relay, "the LCM URL of each process, the segmentation's last")
      ->delimiter(',');
  app.add_option("--lost", options.faults.lost);
  app.add_option("--duplicated", options.faults.duplicated);
  app.add_option("--delayed", options.faults.delayed);
  CLI11_PARSE(app, argc, argv);
  return static_cast<int>(redbee::test::Trial(options).fly());
}
