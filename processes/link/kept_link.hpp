// A link that is opened again where its device goes.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "processes/link/link.hpp"
#include "redbee/node/back_off.hpp"

namespace redbee {

class KeptLink {
 public:
  using Clock = std::function<int64_t()>;  ///< ns, increasing: what Link::receive() stamps with
  static constexpr std::chrono::milliseconds kPass{20};

  /// `name`: as in the configuration, for messages.
  KeptLink(std::string name, std::unique_ptr<Link> link, Clock clock);

  /// Whether the link is open now, after an attempt where one is due (BackOff); otherwise it waits for a
  /// pass. `opened` is called when it was opened.
  bool open(const std::function<void()>& opened);
  /// Waits up to a pass for bytes. Precondition: open.
  ReceivedBytes receive();
  void send(const std::vector<uint8_t>& data) { link_->send(data); }
  bool isDatagram() const { return link_->isDatagram(); }
  int64_t now() const { return clock_(); }  ///< ns
  const std::string& name() const { return name_; }
  /// What is wrong with the device, in one line; empty: nothing.
  const std::string& fault() const { return fault_; }

 private:
  void postpone(const std::string& fault);

  std::string name_;
  std::unique_ptr<Link> link_;
  Clock clock_;
  std::string fault_;
  BackOff back_off_;
};

/// For the key `key` of the configuration, such as autopilot.link. Throws UserError where `text` is empty.
std::unique_ptr<Link> linkOf(const std::string& key, const std::string& text, PeerCheck is_peer);

}  // namespace redbee
