#include "redbee/detection/objects/boosted_trees.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace redbee {
namespace {

constexpr size_t kMost = 1'000'000;  // of anything

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument("boosted trees: " + what); }

template <typename Number>
Number next(std::istream& in, const char* what) {
  Number number{};
  if (!(in >> number)) refuse(std::string("no ") + what);
  return number;
}

size_t nextCount(std::istream& in, const char* what) {
  const auto count = next<long long>(in, what);
  if (count < 1 || count > static_cast<long long>(kMost)) {
    refuse(std::string(what) + " is " + std::to_string(count));
  }
  return static_cast<size_t>(count);
}

}  // namespace

BoostedTrees::BoostedTrees(std::string_view text) {
  std::istringstream in{std::string(text)};
  features_ = nextCount(in, "number of features");
  base_ = next<double>(in, "log odds to begin with");
  const size_t trees = nextCount(in, "number of trees");
  for (size_t tree = 0; tree < trees; ++tree) {
    const size_t first = nodes_.size();
    const int count = static_cast<int>(nextCount(in, "number of nodes"));
    roots_.push_back(first);
    for (int i = 0; i < count; ++i) {
      Node node{};
      node.feature = next<int>(in, "feature");
      node.threshold = next<float>(in, "threshold");
      node.next[1] = next<int>(in, "left node");
      node.next[0] = next<int>(in, "right node");
      node.is_missing_left = next<int>(in, "side of what is missing") != 0;
      if (node.feature < -1 || node.feature >= static_cast<int>(features_))
        refuse("feature " + std::to_string(node.feature));
      for (int& to : node.next) {
        if (node.feature >= 0 && (to <= i || to >= count)) refuse("node " + std::to_string(to));
        to += static_cast<int>(first);
      }
      nodes_.push_back(node);
    }
  }
  if (std::string rest; in >> rest) refuse("\"" + rest + "\" behind the last tree");
}

double BoostedTrees::logOdds(const float* features) const {
  double sum = base_;
  for (const size_t root : roots_) {
    const Node* node = &nodes_[root];
    while (node->feature >= 0) {
      const float value = features[node->feature];
      const bool is_left = std::isnan(value) ? node->is_missing_left : value <= node->threshold;
      node = &nodes_[static_cast<size_t>(node->next[is_left ? 1 : 0])];
    }
    sum += node->threshold;
  }
  return sum;
}

}  // namespace redbee
