// Boosted regression trees (Friedman 2001): log odds as a sum over trees, each node of which compares one
// feature to a threshold.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace redbee {

class BoostedTrees {
 public:
  /// `text`: numbers separated by white space. The number of features, the log odds to begin with, the number
  /// of trees; then of each tree the number of its nodes, and of each node: feature, threshold, left, right,
  /// missing. Left and right are numbers of nodes of the same tree, greater than the node's own; to the left
  /// goes what is at most the threshold, and, if `missing` is 1, what is not a number. Feature -1: a leaf,
  /// whose threshold is its log odds. Throws std::invalid_argument where the text is anything else.
  explicit BoostedTrees(std::string_view text);

  size_t features() const { return features_; }
  /// Log odds. `features`: as many as features().
  double logOdds(const float* features) const;

 private:
  struct Node {
    int feature;              ///< -1: a leaf
    float threshold;          ///< of a leaf its log odds
    std::array<int, 2> next;  ///< right, left
    bool is_missing_left;
  };

  size_t features_ = 0;
  double base_ = 0;
  std::vector<Node> nodes_;
  std::vector<size_t> roots_;
};

}  // namespace redbee
