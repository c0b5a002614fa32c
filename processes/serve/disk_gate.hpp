// How many requests may be answered from the disk at a time, those of slow readers included: the other
// threads of the server are for who looks at the live view.
#pragma once

#include <atomic>
#include <memory>

#include "processes/serve/live.hpp"

namespace redbee {

/// To be used by any thread.
class DiskGate {
 public:
  /// Of three threads a viewer: one has the events, and half of one stays for frames and the page.
  static constexpr int kMost = Live::kMostViewers + Live::kMostViewers / 2;

  /// To be kept while the disk is read, also beyond the gate's end.
  using Ticket = std::shared_ptr<void>;
  /// Null where too many are inside.
  Ticket enter() {
    Ticket ticket(inside_.get(), [inside = inside_](void*) { --*inside; });
    return ++*inside_ <= kMost ? ticket : nullptr;
  }

 private:
  std::shared_ptr<std::atomic<int>> inside_ = std::make_shared<std::atomic<int>>(0);
};

}  // namespace redbee
