// Buffer of IMU samples, sorted by their times.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "redbee/geometry/time.hpp"
#include "redbee/inertial/imu.hpp"

namespace redbee {

/// One end of an integration step.
struct ImuKnot {
  ImuSample sample;  ///< measured, or interpolated between its neighbours
  double gap_s = 0;  ///< time between the two measurements around the step that ends here
};

/// The samples on [begin, end], interpolated at the ends (held constant if there is no sample beyond).
struct ImuSpan {
  std::vector<ImuKnot> knots;  ///< the first at begin, the last at end
  int measured = 0;            ///< samples on (begin, end]
  double longest_gap_s = 0;    ///< over all steps
  double extrapolated_s = 0;   ///< how far the ends reach beyond the first and last sample
};

/// Bounded: the oldest samples are dropped. A sample far from all others in time is held back until the next
/// one confirms that the clock has jumped; then the samples before the jump are erased.
class ImuBuffer {
 public:
  explicit ImuBuffer(double clock_jump_s) : clock_jump_us_(clock_jump_s * 1e6) {}

  void add(const ImuSample& sample);
  void clear() {
    samples_.clear();
    suspect_.reset();
  }
  bool empty() const { return samples_.empty(); }
  std::size_t size() const { return samples_.size(); }
  /// Precondition of all below: not empty.
  ImuTime newest() const { return samples_.back().time; }
  ImuTime oldest() const { return samples_.front().time; }
  ImuSpan span(ImuTime begin, ImuTime end) const;
  /// Samples on [begin, end].
  std::vector<ImuSample> samplesOn(ImuTime begin, ImuTime end) const;
  /// Erases what is not needed for spans that begin at `time` or later.
  void eraseBefore(ImuTime time);

 private:
  ImuSample at(ImuTime time) const;
  bool isFar(ImuTime a, ImuTime b) const;
  void insert(const ImuSample& sample);

  double clock_jump_us_;
  std::deque<ImuSample> samples_;
  std::optional<ImuSample> suspect_;
};

}  // namespace redbee
