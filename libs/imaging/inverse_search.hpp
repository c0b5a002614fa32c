// Dense flow by inverse search (DIS; Kroeger, Timofte, Dai, Van Gool, ECCV 2016), without its variational
// refinement. The result is that of cv::DISOpticalFlow with the same parameters on one thread, to the bit, at
// a fraction of its cost.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "redbee/imaging/inverse_search_kernels.hpp"

namespace redbee {

struct InverseSearchParameters {
  int finest_scale = 0;  ///< halvings of the image at which the search ends
  int iterations = 4;    ///< of the descent: half of them in either direction of the sweeps
  int stride_px = 5;     ///< between patches
};

class InverseSearch {
 public:
  explicit InverseSearch(const InverseSearchParameters& parameters) : parameters_(parameters) {}

  /// Where each pixel of `from` lies in `to`, minus its own position [px]. Images of the same size, at least
  /// a patch at the finest scale. The result is valid until the next call.
  const cv::Mat2f& flow(const cv::Mat1b& from, const cv::Mat1b& to);
  /// px of the image.
  int patch() const { return kSearchPatch_px << parameters_.finest_scale; }

 private:
  struct Scale {
    cv::Mat1b from, to, to_padded;
    cv::Mat2f flow;
  };
  int coarsestScale(cv::Size image) const;
  void prepare(const cv::Mat1b& from, const cv::Mat1b& to);
  SearchLevel levelOf(const Scale& scale);
  void sumOverPatches(const SearchLevel& level);
  void startFrom(const cv::Mat2f& coarser, const SearchLevel& level);

  InverseSearchParameters parameters_;
  std::vector<Scale> scales_;             ///< from the finest
  cv::Mat1s gradient_x_, gradient_y_;     ///< of the scale that is searched
  std::vector<PatchGradients> row_sums_;  ///< of the rows within a patch, and of the one before them
  std::vector<PatchGradients> running_, gradients_;
  std::vector<float> u_, v_, weights_;
  cv::Mat2f full_;
};

}  // namespace redbee
