#include "redbee/detection/objects/association.hpp"

#include <algorithm>
#include <cmath>

#include "redbee/geometry/assignment.hpp"
#include "redbee/geometry/chi_square.hpp"
#include "redbee/imaging/box_overlap.hpp"

namespace redbee {
namespace {

// Errors of components' edges against the rendered clips' truth: 3 px and, relative to the root of the box's
// area, 0.30 rms for peaks of 0.4 to 0.5, falling to 0.14 for those above 0.9.
constexpr double kEdgeSigma_px = 3;
constexpr double kEdgeSigma = 0.45;        // of a peak of 0
constexpr double kEdgeSigmaByPeak = 0.33;  // less at 1

constexpr double kGateProbability = 0.99;
constexpr double kLeastOverlap = 0.1;  // intersection over union

/// Intersection over union of both boxes, grown by the sigma of the predicted position (Yang et al. 2023):
/// what was missed for long need not overlap.
double overlapOf(const BoxFilter& filter, const cv::Rect2d& measured) {
  const double margin = filter.positionSigma();
  return intersectionOverUnion(grown(filter.box(), margin), grown(measured, margin));
}

}  // namespace

BoxMeasurement measurementOf(const Component& component, cv::Size image) {
  const cv::Rect& box = component.box;
  BoxMeasurement measured;
  measured.edges_px << box.x, box.y, box.br().x, box.br().y;
  const double area = box.area();
  const double sigma = kEdgeSigma - kEdgeSigmaByPeak * component.peak;
  measured.variance_px2.setConstant(kEdgeSigma_px * kEdgeSigma_px + sigma * sigma * area);
  // Behind the border the object may reach its own size further.
  if (box.x <= 0) measured.variance_px2(0) += area;
  if (box.y <= 0) measured.variance_px2(1) += area;
  if (box.br().x >= image.width) measured.variance_px2(2) += area;
  if (box.br().y >= image.height) measured.variance_px2(3) += area;
  return measured;
}

Component joined(const std::vector<Component>& all, const std::vector<size_t>& parts) {
  Component whole;
  double gain = 0, residual_around = 0;
  for (const size_t index : parts) {
    const Component& part = all[index];
    whole.box |= part.box;
    whole.area_px += part.area_px;
    whole.score += part.area_px * part.score;
    whole.peak = std::max(whole.peak, part.peak);
    gain += part.area_px * part.gain;
    residual_around += part.area_px * part.residual_around;
  }
  if (whole.area_px > 0) {
    whole.score /= whole.area_px;
    whole.gain = gain / whole.area_px;
    whole.residual_around = residual_around / whole.area_px;
  }
  return whole;
}

std::vector<int> associate(const std::vector<const BoxFilter*>& tracks,
                           const std::vector<Component>& components, const std::vector<size_t>& candidates,
                           cv::Size image) {
  static const double gate = chiSquareQuantile(kGateProbability, 2);
  constexpr double kNoMatch = 1;  // as no overlap, so that the sum of the overlaps is greatest
  const auto rows = static_cast<Eigen::Index>(tracks.size());
  const auto columns = static_cast<Eigen::Index>(candidates.size());
  Eigen::MatrixXd costs = Eigen::MatrixXd::Constant(rows, columns, kNoMatch);
  for (Eigen::Index c = 0; c < columns; ++c) {
    const Component& component = components[candidates[static_cast<size_t>(c)]];
    const BoxMeasurement measured = measurementOf(component, image);
    for (Eigen::Index t = 0; t < rows; ++t) {
      const BoxFilter& filter = *tracks[static_cast<size_t>(t)];
      const double overlap = overlapOf(filter, component.box);
      if (overlap > kLeastOverlap && filter.centreDistance(measured) < gate) costs(t, c) = 1 - overlap;
    }
  }
  std::vector<int> assigned = assign(costs);
  for (size_t t = 0; t < tracks.size(); ++t) {
    int& column = assigned[t];
    if (column == kUnassigned) continue;
    const bool matches = costs(static_cast<Eigen::Index>(t), column) < kNoMatch;
    column = matches ? static_cast<int>(candidates[static_cast<size_t>(column)]) : kUnassigned;
  }
  return assigned;
}

}  // namespace redbee
