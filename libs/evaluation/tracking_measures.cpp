#include "redbee/evaluation/tracking_measures.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "redbee/geometry/assignment.hpp"
#include "redbee/imaging/box_overlap.hpp"

namespace redbee {
namespace {

/// TrackEval's tolerance on thresholds.
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr int kOverlaps = 19;

double overlapAt(int step) { return 0.05 * (step + 1); }

std::vector<int> indicesOf(const std::vector<TrackedBox>& boxes, std::map<int, int>& index) {
  std::set<int> ids;
  std::vector<int> indices;
  for (const TrackedBox& box : boxes) {
    if (!ids.insert(box.id).second)
      throw std::invalid_argument("TrackingEvaluation: identity " + std::to_string(box.id) +
                                  " twice in a frame");
    indices.push_back(index.emplace(box.id, static_cast<int>(index.size())).first->second);
  }
  return indices;
}

struct Match {
  int truth, detected;  ///< positions in the frame
};

/// Pairs of the greatest total score; those with no score are none.
std::vector<Match> bestMatches(const Eigen::MatrixXd& scores) {
  const std::vector<int> columns = assign(-scores);
  std::vector<Match> matches;
  for (size_t row = 0; row < columns.size(); ++row) {
    if (columns[row] != kUnassigned && scores(static_cast<Eigen::Index>(row), columns[row]) > kEpsilon)
      matches.push_back({static_cast<int>(row), columns[row]});
  }
  return matches;
}

double ratio(double part, double whole) { return whole > 0 ? part / whole : 0; }

}  // namespace

void TrackingEvaluation::add(const std::vector<TrackedBox>& truth, const std::vector<TrackedBox>& detected) {
  Frame frame;
  frame.truth = indicesOf(truth, truth_index_);
  frame.detected = indicesOf(detected, detected_index_);
  frame.overlap.create(static_cast<int>(truth.size()), static_cast<int>(detected.size()));
  for (int t = 0; t < frame.overlap.rows; ++t) {
    for (int d = 0; d < frame.overlap.cols; ++d) {
      frame.overlap(t, d) =
          intersectionOverUnion(truth[static_cast<size_t>(t)].box, detected[static_cast<size_t>(d)].box);
    }
  }
  frames_.push_back(frame);
}

TrackingMeasures TrackingEvaluation::measures(double min_overlap) const {
  TrackingMeasures measures;
  measures.frames = static_cast<int64_t>(frames_.size());
  for (const Frame& frame : frames_) {
    measures.truths += static_cast<int64_t>(frame.truth.size());
    measures.detections += static_cast<int64_t>(frame.detected.size());
  }
  addClear(min_overlap, measures);
  addIdentity(min_overlap, measures);
  addHota(measures);
  return measures;
}

void TrackingEvaluation::addClear(double min_overlap, TrackingMeasures& measures) const {
  constexpr double kKeepsIdentity = 1000;  // outweighs every overlap
  constexpr int kNone = -1;
  std::vector<int> last(truth_index_.size(), kNone);         // match in any earlier frame
  std::vector<int> of_previous(truth_index_.size(), kNone);  // match in the previous frame
  double overlap_sum = 0;
  for (const Frame& frame : frames_) {
    Eigen::MatrixXd scores(frame.overlap.rows, frame.overlap.cols);
    for (int t = 0; t < scores.rows(); ++t) {
      for (int d = 0; d < scores.cols(); ++d) {
        const int kept = of_previous[static_cast<size_t>(frame.truth[static_cast<size_t>(t)])];
        const bool keeps = kept == frame.detected[static_cast<size_t>(d)];
        scores(t, d) = frame.overlap(t, d) < min_overlap - kEpsilon
                           ? 0
                           : frame.overlap(t, d) + (keeps ? kKeepsIdentity : 0);
      }
    }
    std::fill(of_previous.begin(), of_previous.end(), kNone);
    for (const Match& match : bestMatches(scores)) {
      const auto truth = static_cast<size_t>(frame.truth[static_cast<size_t>(match.truth)]);
      const int detected = frame.detected[static_cast<size_t>(match.detected)];
      if (last[truth] != kNone && last[truth] != detected) ++measures.id_switches;
      last[truth] = of_previous[truth] = detected;
      ++measures.matches;
      overlap_sum += frame.overlap(match.truth, match.detected);
    }
  }
  const int64_t false_boxes = measures.detections - measures.matches;
  const auto matches = static_cast<double>(measures.matches), truths = static_cast<double>(measures.truths);
  measures.recall = ratio(matches, truths);
  measures.false_boxes_per_frame =
      ratio(static_cast<double>(false_boxes), static_cast<double>(measures.frames));
  measures.mean_overlap = ratio(overlap_sum, matches);
  measures.mota = ratio(static_cast<double>(measures.matches - false_boxes - measures.id_switches), truths);
}

/// One-to-one assignment of whole trajectories that leaves the fewest boxes unexplained.
void TrackingEvaluation::addIdentity(double min_overlap, TrackingMeasures& measures) const {
  const auto truths = static_cast<Eigen::Index>(truth_index_.size());
  const auto tracks = static_cast<Eigen::Index>(detected_index_.size());
  Eigen::MatrixXd common = Eigen::MatrixXd::Zero(truths, tracks);  // frames in which both match
  for (const Frame& frame : frames_) {
    for (int t = 0; t < frame.overlap.rows; ++t) {
      for (int d = 0; d < frame.overlap.cols; ++d) {
        if (frame.overlap(t, d) >= min_overlap)
          common(frame.truth[static_cast<size_t>(t)], frame.detected[static_cast<size_t>(d)]) += 1;
      }
    }
  }
  // Boxes that stay unexplained are all but twice the common ones: the assignment with the most in common.
  double id_matches = 0;
  for (const Match& match : bestMatches(common)) id_matches += common(match.truth, match.detected);
  measures.idf1 = ratio(2 * id_matches, static_cast<double>(measures.truths + measures.detections));
}

void TrackingEvaluation::addHota(TrackingMeasures& measures) const {
  const auto truths = static_cast<Eigen::Index>(truth_index_.size());
  const auto tracks = static_cast<Eigen::Index>(detected_index_.size());
  Eigen::MatrixXd potential = Eigen::MatrixXd::Zero(truths, tracks);
  Eigen::VectorXd truth_count = Eigen::VectorXd::Zero(truths), track_count = Eigen::VectorXd::Zero(tracks);
  for (const Frame& frame : frames_) {
    for (const int t : frame.truth) truth_count(t) += 1;
    for (const int d : frame.detected) track_count(d) += 1;
    for (int t = 0; t < frame.overlap.rows; ++t) {
      for (int d = 0; d < frame.overlap.cols; ++d) {
        const double others = cv::sum(frame.overlap.row(t))[0] + cv::sum(frame.overlap.col(d))[0];
        const double union_of_similarity = others - frame.overlap(t, d);
        if (union_of_similarity <= kEpsilon) continue;
        potential(frame.truth[static_cast<size_t>(t)], frame.detected[static_cast<size_t>(d)]) +=
            frame.overlap(t, d) / union_of_similarity;
      }
    }
  }
  const auto unionOf = [&](const Eigen::MatrixXd& both, Eigen::Index t, Eigen::Index d) {
    return truth_count(t) + track_count(d) - both(t, d);
  };
  std::array<Eigen::MatrixXd, kOverlaps> matched;
  matched.fill(Eigen::MatrixXd::Zero(truths, tracks));
  for (const Frame& frame : frames_) {
    Eigen::MatrixXd scores(frame.overlap.rows, frame.overlap.cols);
    for (int t = 0; t < scores.rows(); ++t) {
      for (int d = 0; d < scores.cols(); ++d) {
        const int truth = frame.truth[static_cast<size_t>(t)], track = frame.detected[static_cast<size_t>(d)];
        scores(t, d) = frame.overlap(t, d) * ratio(potential(truth, track), unionOf(potential, truth, track));
      }
    }
    const std::vector<int> columns = assign(-scores);
    for (size_t t = 0; t < columns.size(); ++t) {
      if (columns[t] == kUnassigned) continue;
      const double overlap = frame.overlap(static_cast<int>(t), columns[t]);
      for (int step = 0; step < kOverlaps; ++step) {
        if (overlap >= overlapAt(step) - kEpsilon)
          matched[static_cast<size_t>(step)](frame.truth[t],
                                             frame.detected[static_cast<size_t>(columns[t])]) += 1;
      }
    }
  }
  for (const Eigen::MatrixXd& pairs : matched) {
    const double matches = pairs.sum();
    double association = 0;
    for (Eigen::Index t = 0; t < truths; ++t) {
      for (Eigen::Index d = 0; d < tracks; ++d)
        association += pairs(t, d) * ratio(pairs(t, d), unionOf(pairs, t, d));
    }
    association = ratio(association, matches);
    const double detection =
        ratio(matches, static_cast<double>(measures.truths + measures.detections) - matches);
    measures.detection_accuracy += detection / kOverlaps;
    measures.association_accuracy += association / kOverlaps;
    measures.hota += std::sqrt(detection * association) / kOverlaps;
  }
}

}  // namespace redbee
