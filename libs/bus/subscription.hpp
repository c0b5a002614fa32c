// A subscription that ends when its owner is destroyed (RAII).
#pragma once

#include <functional>
#include <utility>

namespace redbee {

/// The handler is not called after destruction. To be used by the thread that calls Bus::handle(); may be
/// destroyed inside a handler, its own included, and may outlive its bus.
class [[nodiscard]] Subscription {
 public:
  Subscription() = default;
  /// `end`: called once, when the subscription ends.
  explicit Subscription(std::function<void()> end) : end_(std::move(end)) {}
  Subscription(Subscription&& other) noexcept : end_(std::exchange(other.end_, nullptr)) {}
  Subscription& operator=(Subscription&& other) noexcept {
    if (this != &other) {
      end();
      end_ = std::exchange(other.end_, nullptr);
    }
    return *this;
  }
  Subscription(const Subscription&) = delete;
  Subscription& operator=(const Subscription&) = delete;
  ~Subscription() { end(); }

 private:
  void end() noexcept {
    if (const auto end = std::exchange(end_, nullptr)) end();
  }

  std::function<void()> end_;
};

}  // namespace redbee
