// A mixture of Gaussians of the grey value per pixel, the number of Gaussians adapted to the data (Zivkovic,
// "Improved adaptive Gaussian mixture model for background subtraction", ICPR 2004; the paper's [3]). Two
// departures: each pixel has its own age, as pixels enter a moving camera's view at different times, and
// until the history is full means and variances are plain averages; and the model can be warped by a
// homography.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace redbee {

class GaussianMixture {
 public:
  /// `threshold`: squared Mahalanobis distance within which a value belongs to a Gaussian of the background.
  GaussianMixture(cv::Size size, int history_frames, double threshold);

  /// Learns the values of `grey` where `valid` is not 0. Returns 255 where a valid pixel does not match the
  /// background before the update, else 0.
  cv::Mat1b update(const cv::Mat1b& grey, const cv::Mat1b& valid);

  /// 255 where fewer than `frames` values have been learned.
  cv::Mat1b unknown(int frames) const;

  /// Warps the model: model(x) = model(H^-1 x), by nearest neighbour, as interpolated Gaussians are
  /// meaningless. New pixels have age 0.
  void move(const Eigen::Matrix3d& H);

 private:
  struct Gaussian {
    float weight = 0;  ///< 0: not in use
    float mean = 0;
    float variance = 0;
  };
  static constexpr int kGaussians = 3;
  struct Pixel {
    std::array<Gaussian, kGaussians> gaussians;  ///< in order of decreasing weight
    uint16_t age = 0;
  };

  bool learn(Pixel& pixel, float value) const;
  void addGaussian(Pixel& pixel, float value, float rate) const;

  cv::Size size_;
  int history_;
  float threshold_;
  std::vector<Pixel> pixels_;
};

}  // namespace redbee
