// The median of a sample.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace redbee {

/// Of an even number the upper one of both in the middle. Precondition: there is one.
template <typename Value>
Value median(std::vector<Value> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace redbee
