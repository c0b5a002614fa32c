#include "redbee/inertial/inertial_filter.hpp"

#include "redbee/inertial/filter_implementation.hpp"

namespace redbee {

InertialFilter::InertialFilter(const Camera& camera, const InertialParameters& parameters)
    : implementation_(std::make_unique<Implementation>(camera, parameters)) {}
InertialFilter::~InertialFilter() = default;
InertialFilter::InertialFilter(InertialFilter&&) noexcept = default;
InertialFilter& InertialFilter::operator=(InertialFilter&&) noexcept = default;

bool InertialFilter::addMount(const MountSample& sample) { return implementation_->addMount(sample); }
bool InertialFilter::coversMount(CameraTime frame) const { return implementation_->coversMount(frame); }
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
const VisionAgreement& InertialFilter::agreement() const { return implementation_->agreement(); }
SnapshotCheck InertialFilter::warmStart(const FilterSnapshot& known) {
  return implementation_->warmStart(known);
}

}  // namespace redbee
