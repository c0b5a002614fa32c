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
/// passes the frames since then once more: its state is the one that it would have, had nothing been late.
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

  CorrectionReport correct(const HomographyObservation& observation) {
    const auto at = std::find_if(passed_.begin(), passed_.end(), [&](const Passed& passed) {
      return passed.checkpoint.frame == observation.time;
    });
    if (at == passed_.end() || std::next(at) == passed_.end()) return correctNow(observation);
    if (at->observation || at->checkpoint.previous_frame != observation.time_previous) return {};
    if (!at->checkpoint.state.isMountKnown()) return {};
    const std::vector<Passed> again(std::next(at), passed_.end());
    returnTo(at->checkpoint);
    passed_.erase(std::next(at), passed_.end());
    const CorrectionReport report = correctNow(observation);
    for (const Passed& passed : again) {
      advanceTo(passed.checkpoint.frame);
      if (passed.observation) correctNow(*passed.observation, Comparison::kDone);
    }
    return report;
  }

 private:
  struct Passed {
    FilterCheckpoint checkpoint;
    std::optional<HomographyObservation> observation;  ///< that it was given
  };

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
  return implementation_->correct(observation);
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
