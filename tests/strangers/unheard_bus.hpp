// What a stranger sends where nobody listens: it hears the stack, works and sends as ever, and reaches no
// process.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "redbee/bus/bus.hpp"

namespace redbee::test {

class UnheardBus : public Bus {
 public:
  using Bus::publish;
  using Bus::subscribe;

  explicit UnheardBus(const std::string& heard_url)
      : heard_(makeLcmBus(heard_url)),
        unheard_(makeLcmBus("udpm://239.255.76.99:7699?ttl=0&recv_buf_size=4194304")) {}

  void publish(const std::string& channel, const std::vector<uint8_t>& data) override {
    unheard_->publish(channel, data);
  }
  Subscription subscribe(const std::string& channel, int capacity, Handler handler) override {
    return heard_->subscribe(channel, capacity, std::move(handler));
  }
  int handle(std::chrono::milliseconds timeout) override { return heard_->handle(timeout); }

 private:
  std::unique_ptr<Bus> heard_;
  std::unique_ptr<Bus> unheard_;
};

}  // namespace redbee::test
