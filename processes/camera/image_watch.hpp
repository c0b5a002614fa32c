// Whether a camera's images are those of a camera that works.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "redbee/image_t.hpp"

namespace redbee {

class ImageWatch {
 public:
  static constexpr int kFrozenAfter = 5;  ///< equal images in a row; noise makes those of a sensor differ
  static constexpr int kLookPeriod = 12;  ///< images, of which one is looked at for black: that decodes it
  static constexpr double kDark =
      20;  ///< grey levels that a black image does not exceed but for a thousandth of it
  static constexpr double kSlowBelow = 0.8;  ///< of the rate that is expected

  /// `rate_hz`: expected; 0: any.
  explicit ImageWatch(double rate_hz) : rate_hz_(rate_hz) {}

  void note(const image_t& image);
  /// Empty for a camera that works; otherwise what is wrong, without figures that change.
  std::string fault() const;

 private:
  bool isSlow() const;

  double rate_hz_;
  std::vector<uint8_t> last_;
  int repeats_ = 0;
  int64_t images_ = 0;
  bool is_black_ = false;
  std::deque<int64_t> times_us_;
};

}  // namespace redbee
