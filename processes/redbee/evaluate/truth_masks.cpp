#include "processes/redbee/evaluate/truth_masks.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <opencv2/imgproc.hpp>
#include <set>

#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"
#include "redbee/image_codec/image_codec.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

constexpr uint8_t kUnknownLabel = 128;

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

bool isNamedJpeg(const fs::path& file) { return file.extension() == ".jpg" || file.extension() == ".jpeg"; }

/// One channel if the image is grey, also where it is stored in colour; otherwise BGR.
cv::Mat readImage(const fs::path& file) {
  cv::Mat image = decodeImage(readWhole(file));
  if (image.empty()) throw InputError(file, "not a readable image");
  if (image.depth() != CV_8U) throw InputError(file, "has 16 bits a pixel; masks have 8");
  if (image.channels() == 1) return image;
  std::array<cv::Mat, 3> bgr;
  cv::split(image, bgr);
  const bool is_grey =
      cv::norm(bgr[0], bgr[1], cv::NORM_INF) == 0 && cv::norm(bgr[0], bgr[2], cv::NORM_INF) == 0;
  return is_grey ? bgr[0] : image;
}

/// Compression changes the values a little.
cv::Mat1b fromJpeg(const fs::path& file, const cv::Mat& image) {
  constexpr int kStatic = 63, kMoving = 192;
  constexpr double kClear = 0.95;  // of the pixels of a mask; an image has most of them between
  cv::Mat1b grey;
  image.channels() == 1 ? image.copyTo(grey) : cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  const cv::Mat moving = grey >= kMoving;
  const cv::Mat still = grey <= kStatic;
  if (cv::countNonZero(moving | still) < kClear * static_cast<double>(grey.total()))
    throw InputError(file, "is an image, not a mask: most of it is neither black nor white");
  cv::Mat1b labels(grey.size(), kUnknownLabel);
  labels.setTo(255, moving);
  labels.setTo(0, still);
  return labels;
}

cv::Mat1b fromColours(const fs::path& file, const cv::Mat3b& image) {
  const cv::Vec3b void_colour(192, 224, 224);  // BGR
  constexpr size_t kPalette = 256;
  std::set<std::array<uint8_t, 3>> colours;
  cv::Mat1b labels(image.size());
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const cv::Vec3b& colour = image(y, x);
      colours.insert({colour[0], colour[1], colour[2]});
      const bool is_black = colour == cv::Vec3b(0, 0, 0);
      labels(y, x) = is_black ? 0 : colour == void_colour ? kUnknownLabel : 255;
    }
    if (colours.size() > kPalette)
      throw InputError(file, "is an image, not a mask: it has hundreds of colours");
  }
  return labels;
}

/// Values that stand for "unknown" in masks without any 255: our own, and CDnet's shadow, outside and
/// unknown.
bool isUnknownValue(int value) {
  return value == 50 || value == 85 || value == 127 || value == 128 || value == 170;
}

}  // namespace

std::vector<fs::path> masksIn(const fs::path& folder) {
  std::vector<fs::path> pngs, jpegs;
  if (!fs::is_directory(folder)) return pngs;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".png") pngs.push_back(entry.path());
    if (isNamedJpeg(entry.path())) jpegs.push_back(entry.path());
  }
  std::vector<fs::path>& masks = pngs.empty() ? jpegs : pngs;
  std::sort(masks.begin(), masks.end());
  return masks;
}

int64_t numberIn(const fs::path& file) {
  const std::string stem = file.stem().string();
  size_t first = stem.size();
  while (first > 0 && isDigit(stem[first - 1])) --first;
  int64_t number = 0;
  const auto [end, error] = std::from_chars(stem.data() + first, stem.data() + stem.size(), number);
  if (error != std::errc() || end == stem.data() + first)
    throw InputError(file, "its name does not end with a time or a frame number");
  return number;
}

bool looksLikeFrameNumber(const fs::path& file) {
  const std::string stem = file.stem().string();
  return !isDigit(stem.front()) || (stem.size() > 1 && stem.front() == '0');
}

bool countsFromOne(const fs::path& file) {
  const std::string stem = file.stem().string();
  return stem.size() > 2 && stem.compare(0, 2, "gt") == 0 && isDigit(stem[2]);
}

TruthMasks::TruthMasks(const std::vector<fs::path>& files) {
  int largest = 0;
  fs::path with_number;
  int number = 0;
  for (const fs::path& file : files) {
    if (isNamedJpeg(file)) return;
    const cv::Mat image = readImage(file);
    if (image.channels() == 3) continue;
    double most = 0;
    cv::minMaxLoc(image, nullptr, &most);
    largest = std::max(largest, static_cast<int>(most));
    if (largest == 255) return;
    for (int value = 2; value <= largest && with_number.empty(); ++value) {
      if (isUnknownValue(value) || cv::countNonZero(image == value) == 0) continue;
      with_number = file;
      number = value;
    }
  }
  if (largest == 1) moving_ = 1;
  if (with_number.empty()) return;
  throw InputError(with_number,
                   "holds the value " + std::to_string(number) +
                       ", and no mask of the clip holds 255: expected are 255 where something moves, "
                       "or 0 and 1, or the colours of a palette");
}

cv::Mat1b TruthMasks::read(const fs::path& file) const {
  cv::Mat image = readImage(file);
  if (isNamedJpeg(file)) return fromJpeg(file, image);
  if (image.channels() == 3) return fromColours(file, image);
  if (moving_ == 255) return image;
  return image * 255;
}

}  // namespace redbee
