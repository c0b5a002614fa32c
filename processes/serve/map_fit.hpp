// Whether the ground's plane, as it is estimated frame by frame, still agrees with the live mosaic's map.
#pragma once

#include <cstdint>

namespace redbee {

/// A plane is known to some percent, and to a degree or two; frames that disagree for less than a second may
/// be a fault of the plane.
class MapFit {
 public:
  static constexpr double kMisfit = 1.25;  ///< of lengths
  static constexpr int64_t kMisfit_us = 1'000'000;
  static constexpr int64_t kUnknown_us = 500'000;  ///< without a plane: what was before says nothing of now

  /// A map was laid by the plane of this time.
  void laid(int64_t utime) { fits_utime_ = utime; }

  /// `misfit`: see MapReference. Returns whether the map has been contradicted for so long that it is to be
  /// laid anew.
  bool isContradicted(int64_t utime, double misfit) {
    if (utime > judged_utime_ + kUnknown_us) fits_utime_ = utime;
    judged_utime_ = utime;
    if (misfit < kMisfit || utime < fits_utime_) fits_utime_ = utime;
    return utime >= fits_utime_ + kMisfit_us;
  }

 private:
  int64_t fits_utime_ = 0;    ///< us, of the last plane that fits the map
  int64_t judged_utime_ = 0;  ///< us, of the last that was asked
};

}  // namespace redbee
