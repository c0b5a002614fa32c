#include "segmentation/carried_background.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

constexpr int kColours = 3;
constexpr float kFirstVariance = 400;  // of a pixel seen once: it may lie on an edge
constexpr float kMostVariance = 1000;  // what passes by is not the background's variance
constexpr int kTrusted = 3;            // pictures after which what moves is told from what is new
constexpr double kVarianceSpan_s = 0.4;
constexpr float kMovingShare = 0.05F;  // of the learning rate, where it moves for sure

using Pixel = Eigen::Map<Eigen::Array4f>;
using ConstPixel = Eigen::Map<const Eigen::Array4f>;

Eigen::Array4f colourOf(const uint8_t* bgr) {
  return {static_cast<float>(bgr[0]), static_cast<float>(bgr[1]), static_cast<float>(bgr[2]), 0};
}

/// Mean square over the three channels; the fourth does not count.
float meanSquare(const Eigen::Array4f& difference) {
  return difference.head<kColours>().square().sum() / kColours;
}

/// The model resampled along a row. Between knots the source moves linearly: over so few pixels perspective
/// bends a path by less than a thousandth of one.
class RowCarrier {
 public:
  RowCarrier(const cv::Mat& model, const cv::Mat& age, cv::Mat& model_to, cv::Mat& age_to)
      : model_(model), age_(age), model_to_(model_to), age_to_(age_to) {}

  /// Pixels begin to end of row y, which `back` takes into the earlier picture.
  void carry(const Eigen::Matrix3f& back, int y, int begin, int end) {
    constexpr int kKnot = 16;
    for (int x = begin; x < end; x += kKnot) {
      const int next = std::min(x + kKnot, end);
      const Eigen::Vector2f first = source(back, x, y);
      const Eigen::Vector2f step = (source(back, next, y) - first) / static_cast<float>(next - x);
      for (int i = x; i < next; ++i) sample(first + static_cast<float>(i - x) * step, y, i);
    }
  }

 private:
  static Eigen::Vector2f source(const Eigen::Matrix3f& back, int x, int y) {
    return (back * Eigen::Vector3f(static_cast<float>(x), static_cast<float>(y), 1)).hnormalized();
  }

  void sample(const Eigen::Vector2f& from, int y, int x) {
    // Written so that what is not a number is outside, too.
    const bool inside = from.x() >= 0 && from.y() >= 0 && from.x() < static_cast<float>(model_.cols - 1) &&
                        from.y() < static_cast<float>(model_.rows - 1);
    if (!inside) {
      age_to_.at<uint8_t>(y, x) = 0;
      return;
    }
    const int column = static_cast<int>(from.x());
    const int row = static_cast<int>(from.y());
    const float right = from.x() - static_cast<float>(column);
    const float below = from.y() - static_cast<float>(row);
    const float* top = model_.ptr<float>(row) + 4 * column;
    const float* bottom = model_.ptr<float>(row + 1) + 4 * column;
    const Eigen::Array4f upper = ConstPixel(top) + right * (ConstPixel(top + 4) - ConstPixel(top));
    const Eigen::Array4f lower = ConstPixel(bottom) + right * (ConstPixel(bottom + 4) - ConstPixel(bottom));
    Pixel(model_to_.ptr<float>(y) + 4 * x) = upper + below * (lower - upper);
    age_to_.at<uint8_t>(y, x) =
        age_.ptr<uint8_t>(row + (below > 0.5F ? 1 : 0))[column + (right > 0.5F ? 1 : 0)];
  }

  const cv::Mat& model_;
  const cv::Mat& age_;
  cv::Mat& model_to_;
  cv::Mat& age_to_;
};

/// Where along row y the ground begins or ends, and whether the row begins with it.
struct HorizonCut {
  int at;
  bool ground_first;
};
HorizonCut cutAtHorizon(const Eigen::RowVector3d& horizon, int y, int width) {
  const double at_left = horizon.y() * y + horizon.z();
  if (horizon.x() == 0) return {width, at_left > 0};
  const double crossing = std::clamp(std::ceil(-at_left / horizon.x()), 0.0, static_cast<double>(width));
  return {static_cast<int>(crossing), horizon.x() < 0};
}

}  // namespace

void CarriedBackground::reset() {
  model_.release();
  age_.release();
}

void CarriedBackground::carry(const SceneMotion& scene) {
  if (model_.empty()) return;
  const Eigen::Matrix3f ground = scene.ground.inverse().cast<float>();
  const Eigen::Matrix3f far = scene.far.inverse().cast<float>();
  cv::Mat model(model_.size(), model_.type(), cv::Scalar::all(0));
  cv::Mat age(age_.size(), age_.type());
  RowCarrier carrier(model_, age_, model, age);
  for (int y = 0; y < model.rows; ++y) {
    const HorizonCut cut = cutAtHorizon(scene.horizon, y, model.cols);
    carrier.carry(cut.ground_first ? ground : far, y, 0, cut.at);
    carrier.carry(cut.ground_first ? far : ground, y, cut.at, model.cols);
  }
  model_ = model;
  age_ = age;
}

cv::Mat CarriedBackground::unlike(const cv::Mat& colour) const {
  cv::Mat evidence = cv::Mat::zeros(colour.size(), CV_32F);
  if (model_.empty()) return evidence;
  for (int y = 0; y < colour.rows; ++y) {
    const uint8_t* now = colour.ptr(y);
    const float* known = model_.ptr<float>(y);
    float* to = evidence.ptr<float>(y);
    for (int x = 0; x < colour.cols; ++x)
      to[x] = meanSquare(colourOf(now + kColours * x) - ConstPixel(known + 4 * x));
  }
  const int window = parameters_.silhouette_window_px;
  cv::blur(evidence, evidence, {window, window});
  const auto noise2 = static_cast<float>(parameters_.background_noise * parameters_.background_noise);
  for (int y = 0; y < colour.rows; ++y) {
    const float* known = model_.ptr<float>(y);
    const uint8_t* age = age_.ptr(y);
    float* to = evidence.ptr<float>(y);
    for (int x = 0; x < colour.cols; ++x) {
      to[x] = age[x] == 0 ? 0 : to[x] / (to[x] + known[4 * x + kColours] + noise2);
    }
  }
  return evidence;
}

void CarriedBackground::learn(const cv::Mat& colour, const cv::Mat& moving, double elapsed_s) {
  if (model_.empty()) {
    model_ = cv::Mat::zeros(colour.size(), CV_32FC4);
    age_ = cv::Mat::zeros(colour.size(), CV_8U);
  }
  const auto slowest = static_cast<float>(elapsed_s / parameters_.background_span_s);
  const auto slowest_variance = static_cast<float>(elapsed_s / kVarianceSpan_s);
  for (int y = 0; y < colour.rows; ++y) {
    const uint8_t* now = colour.ptr(y);
    const float* moves = moving.ptr<float>(y);
    float* known = model_.ptr<float>(y);
    uint8_t* age = age_.ptr(y);
    for (int x = 0; x < colour.cols; ++x) {
      const Eigen::Array4f difference = colourOf(now + kColours * x) - ConstPixel(known + 4 * x);
      const float mean_rate = 1 / (static_cast<float>(age[x]) + 1);
      const float keep = age[x] < kTrusted ? 1 : 1 - (1 - kMovingShare) * moves[x];
      const float rate = std::min(std::max(mean_rate, slowest), 1.0F) * keep;
      const float variance_rate = std::min(std::max(mean_rate, slowest_variance), 1.0F);
      const float variance = known[4 * x + kColours];
      Pixel(known + 4 * x) += rate * difference;
      known[4 * x + kColours] =
          age[x] == 0
              ? kFirstVariance
              : variance + variance_rate * (std::min(meanSquare(difference), kMostVariance) - variance);
      age[x] = static_cast<uint8_t>(std::min(age[x] + 1, 255));
    }
  }
}

}  // namespace redbee
