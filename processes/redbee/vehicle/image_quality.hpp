// Exposure and sharpness of a camera's images.
#pragma once

#include <cstdint>
#include <vector>

#include "redbee/image_t.hpp"

namespace redbee {

class ImageQuality {
 public:
  static constexpr double kDark = 20;     ///< grey levels: ImageWatch::kDark
  static constexpr double kBright = 250;  ///< grey levels from which a pixel is saturated

  /// One of several images is looked at: that decodes it.
  void note(const image_t& image);

  int64_t looked() const { return static_cast<int64_t>(medians_.size()); }
  int64_t damaged() const { return damaged_; }
  /// Medians over the images. Precondition of all: looked() > 0.
  double greyMedian() const;         ///< grey levels
  double contrast() const;           ///< grey levels, standard deviation within an image
  double saturatedFraction() const;  ///< of the image
  double darkFraction() const;       ///< of the image
  double sharpness() const;          ///< grey levels^2 (visual/sharpness.hpp)

 private:
  int64_t images_ = 0;
  int64_t damaged_ = 0;
  std::vector<double> medians_, contrasts_, saturated_, dark_, sharpness_;
};

}  // namespace redbee
