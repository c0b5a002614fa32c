#include "redbee/inertial/inertial_filter.hpp"

#include <algorithm>
#include <deque>
#include <iterator>
#include <utility>
#include <vector>

#include "redbee/inertial/inertial_filter_core.hpp"

namespace redbee {
namespace {

/// An observation may come this long after its frame; the samples since then are kept for a second.
constexpr Duration kLatest = std::chrono::milliseconds(750);

}  // namespace

/// Where an observation of an earlier frame arrives, the filter returns to that frame, is corrected, and
/// passes the frames since then once more: its state is the one that it would have, had nothing been late. Of
/// several that arrive together each is given to it on the same way back.
class InertialFilter::Implementation : public InertialFilterCore {
 public:
  using InertialFilterCore::InertialFilterCore;

  bool addAltitude(const AltitudeSample& sample) {
    for (Passed& passed : passed_) passed.checkpoint.altitude.add(sample);
    return InertialFilterCore::addAltitude(sample);
  }

  InertialHomography advanceTo(CameraTime frame) {
    InertialHomography result = InertialFilterCore::advanceTo(frame);
    remember();
    return result;
  }

  std::vector<CorrectionReport> correct(const std::vector<HomographyObservation>& observations) {
    std::vector<CorrectionReport> reports(observations.size());
    CameraTime given = CameraTime::min();  // of the newest observation that was given on the way back
    for (size_t i = 0; i < observations.size(); ++i) {
      const HomographyObservation& observation = observations[i];
      if (observation.time <= given) continue;
      const auto at = std::find_if(passed_.begin(), passed_.end(), [&](const Passed& passed) {
        return passed.checkpoint.frame == observation.time;
      });
      if (at == passed_.end() || std::next(at) == passed_.end()) {
        reports[i] = correctNow(observation);
        continue;
      }
      if (!isWanted(*at, observation)) continue;
      const std::vector<Passed> again(std::next(at), passed_.end());
      returnTo(at->checkpoint);
      passed_.erase(std::next(at), passed_.end());
      reports[i] = correctNow(observation);
      given = passAgain(again, observations, reports);
    }
    return reports;
  }

 private:
  struct Passed {
    FilterCheckpoint checkpoint;
    std::optional<HomographyObservation> observation;  ///< that it was given
  };

  static bool isWanted(const Passed& passed, const HomographyObservation& observation) {
    return !passed.observation && passed.checkpoint.previous_frame == observation.time_previous &&
           passed.checkpoint.state.isMountKnown();
  }

  /// Passes the frames, with their observations and, on the way, those of `observations` that are due; the
  /// newest frame's is left. Returns the last frame before that.
  CameraTime passAgain(const std::vector<Passed>& frames,
                       const std::vector<HomographyObservation>& observations,
                       std::vector<CorrectionReport>& reports) {
    CameraTime last = CameraTime::min();
    for (size_t k = 0; k < frames.size(); ++k) {
      const CameraTime frame = frames[k].checkpoint.frame;
      advanceTo(frame);
      if (frames[k].observation) correctNow(*frames[k].observation, Comparison::kDone);
      if (k + 1 == frames.size()) break;
      last = frame;
      const auto due = std::find_if(observations.begin(), observations.end(),
                                    [&](const HomographyObservation& z) { return z.time == frame; });
      if (due == observations.end() || passed_.empty() || !isWanted(passed_.back(), *due)) continue;
      reports[static_cast<size_t>(due - observations.begin())] = correctNow(*due);
    }
    return last;
  }

  void remember() {
    std::optional<FilterCheckpoint> now = checkpoint();
    if (!now) return passed_.clear();                                               // it has begun again
    if (!passed_.empty() && now->frame == passed_.back().checkpoint.frame) return;  // it did not move
    if (!passed_.empty() && now->previous_frame != passed_.back().checkpoint.frame) passed_.clear();
    passed_.push_back({*std::move(now), std::nullopt});
    while (passed_.back().checkpoint.frame - passed_.front().checkpoint.frame > kLatest) passed_.pop_front();
  }

  CorrectionReport correctNow(const HomographyObservation& observation,
                              Comparison comparison = Comparison::kDue) {
    const CorrectionReport report = InertialFilterCore::correct(observation, comparison);
    const bool was_tried = report.applied || report.test_ratio > 0;
    if (was_tried && !passed_.empty()) passed_.back().observation = observation;
    return report;
  }

  std::deque<Passed> passed_;  ///< in order of time; the last is the newest frame
};

InertialFilter::InertialFilter(const Camera& camera, const InertialParameters& parameters)
    : implementation_(std::make_unique<Implementation>(camera, parameters)) {}
InertialFilter::~InertialFilter() = default;
InertialFilter::InertialFilter(InertialFilter&&) noexcept = default;
InertialFilter& InertialFilter::operator=(InertialFilter&&) noexcept = default;

bool InertialFilter::addMount(const MountSample& sample) { return implementation_->addMount(sample); }
bool InertialFilter::coversMount(CameraTime frame) const { return implementation_->coversMount(frame); }
bool InertialFilter::addLens(const LensSample& sample) { return implementation_->addLens(sample); }
bool InertialFilter::coversLens(CameraTime frame) const { return implementation_->coversLens(frame); }
bool InertialFilter::addImu(const ImuSample& sample) { return implementation_->addImu(sample); }
int InertialFilter::takeForeignSamples() { return implementation_->takeForeignSamples(); }
bool InertialFilter::addAltitude(const AltitudeSample& sample) {
  return implementation_->addAltitude(sample);
}
bool InertialFilter::covers(CameraTime frame) const { return implementation_->covers(frame); }
InertialHomography InertialFilter::advanceTo(CameraTime frame) { return implementation_->advanceTo(frame); }
CorrectionReport InertialFilter::correct(const HomographyObservation& observation) {
  return implementation_->correct({observation}).front();
}
std::vector<CorrectionReport> InertialFilter::correct(
    const std::vector<HomographyObservation>& observations) {
  return implementation_->correct(observations);
}
std::optional<NominalState> InertialFilter::state() const { return implementation_->state(); }
const std::optional<FilterSnapshot>& InertialFilter::snapshot() const { return implementation_->snapshot(); }
bool InertialFilter::isAtFirstFrame() const { return implementation_->isAtFirstFrame(); }
const VisionAgreement& InertialFilter::agreement() const { return implementation_->comparison().agreement; }
const TimeshiftMonitor& InertialFilter::timeshift() const { return implementation_->comparison().timeshift; }
SnapshotCheck InertialFilter::warmStart(const FilterSnapshot& known) {
  return implementation_->warmStart(known);
}

}  // namespace redbee
