#include "processes/camera/image_watch.hpp"

#include <opencv2/core.hpp>

#include "redbee/bus/image.hpp"

namespace redbee {
namespace {

constexpr size_t kRateWindow = 48;  // images
constexpr size_t kFewest = 24;      // before a rate is known

/// A dead pixel or a time stamp in the corner is not light.
bool isBlack(const image_t& image, double dark) {
  const bool can_shrink = image.width % 4 == 0 && image.height % 4 == 0;
  const auto grey = decodeGrey(image, can_shrink ? 4 : 1);
  return grey && cv::countNonZero(*grey > dark) * 1000 < static_cast<int>(grey->total());
}

}  // namespace

void ImageWatch::note(const image_t& image) {
  repeats_ = image.data == last_ ? repeats_ + 1 : 0;
  last_ = image.data;
  if (images_++ % kLookPeriod == 0) is_black_ = isBlack(image, kDark);
  times_us_.push_back(image.utime);
  if (times_us_.size() > kRateWindow) times_us_.pop_front();
}

bool ImageWatch::isSlow() const {
  if (rate_hz_ <= 0 || times_us_.size() < kFewest) return false;
  const double span_s = static_cast<double>(times_us_.back() - times_us_.front()) * 1e-6;
  return static_cast<double>(times_us_.size() - 1) < kSlowBelow * rate_hz_ * span_s;
}

std::string ImageWatch::fault() const {
  if (is_black_) return "the images are black: is the lens covered, or the exposure closed?";
  if (repeats_ >= kFrozenAfter) return "the camera repeats one image: it is frozen";
  if (isSlow()) return "fewer than 4 of 5 images of the rate that is configured arrive";
  return "";
}

}  // namespace redbee
