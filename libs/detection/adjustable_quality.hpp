// A detector that can do with less work: what an overloaded stage leaves out before it skips frames.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace redbee {

class AdjustableQuality {
 public:
  virtual ~AdjustableQuality() = default;

  /// What is left out at each rung, in addition to that of the rungs above it; of rung 1 first.
  virtual std::vector<std::string> rungs() const = 0;
  /// Of the frames from now on. 0: as configured; at most the number of rungs. Background and tracks stay.
  virtual void setQuality(size_t rung) = 0;
};

}  // namespace redbee
