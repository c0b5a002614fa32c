#include "redbee/image_codec/huffman_code.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace redbee {
namespace {

/// Depths of the leaves of Huffman's tree; 0 for what does not occur. Two symbols or more must.
std::vector<uint8_t> depthsOf(const std::vector<uint32_t>& counts) {
  struct Node {
    size_t parent = 0;
  };
  std::vector<Node> nodes(counts.size());
  using Weighted = std::pair<uint64_t, size_t>;
  std::priority_queue<Weighted, std::vector<Weighted>, std::greater<>> lightest;
  for (size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0) lightest.emplace(counts[i], i);
  }
  while (lightest.size() > 1) {
    const Weighted a = lightest.top();
    lightest.pop();
    const Weighted b = lightest.top();
    lightest.pop();
    nodes[a.second].parent = nodes[b.second].parent = nodes.size();
    lightest.emplace(a.first + b.first, nodes.size());
    nodes.emplace_back();
  }
  std::vector<uint8_t> depths(nodes.size(), 0);
  for (size_t i = nodes.size() - 1; i-- > 0;) {
    if (nodes[i].parent != 0) depths[i] = static_cast<uint8_t>(depths[nodes[i].parent] + 1);
  }
  depths.resize(counts.size());
  return depths;
}

/// Where the tree is too deep, rare symbols are taken for more frequent ones.
std::vector<uint8_t> lengthsOf(std::vector<uint32_t> counts, int longest) {
  while (true) {
    std::vector<uint8_t> lengths = depthsOf(counts);
    if (*std::max_element(lengths.begin(), lengths.end()) <= longest) return lengths;
    for (uint32_t& count : counts) count = (count + 1) / 2;
  }
}

}  // namespace

HuffmanCode huffmanCode(const std::vector<uint32_t>& counts, int longest) {
  HuffmanCode code{lengthsOf(counts, longest), std::vector<uint16_t>(counts.size(), 0)};
  uint32_t next = 0;
  for (int length = 1; length <= longest; ++length, next <<= 1U) {
    for (size_t i = 0; i < counts.size(); ++i) {
      if (code.lengths[i] != length) continue;
      uint32_t reversed = 0;
      for (int bit = 0; bit < length; ++bit)
        reversed = reversed << 1U | (next >> static_cast<unsigned>(bit) & 1U);
      code.bits[i] = static_cast<uint16_t>(reversed);
      ++next;
    }
  }
  return code;
}

}  // namespace redbee
