#include "processes/link/kept_link.hpp"

#include <spdlog/spdlog.h>

#include <thread>
#include <utility>

#include "redbee/files/user_error.hpp"

namespace redbee {

KeptLink::KeptLink(std::string name, std::unique_ptr<Link> link, Clock clock)
    : name_(std::move(name)), link_(std::move(link)), clock_(std::move(clock)) {}

void KeptLink::postpone(const std::string& fault) {
  if (fault != fault_) spdlog::warn("{}", fault);
  fault_ = fault;
  back_off_.postpone(clock_());
}

bool KeptLink::open(const std::function<void()>& opened) {
  if (link_->isOpen()) return true;
  if (!back_off_.isDue(clock_())) {
    std::this_thread::sleep_for(kPass);
    return false;
  }
  if (const std::string fault = link_->open(); !fault.empty()) {
    postpone(fault);
    return false;
  }
  spdlog::info("{}: open", name_);
  fault_.clear();
  opened();
  return true;
}

ReceivedBytes KeptLink::receive() {
  ReceivedBytes received = link_->receive(kPass);
  if (!received.data.empty()) back_off_.reset();
  if (!link_->isOpen()) postpone(name_ + ": the device is gone");
  return received;
}

std::unique_ptr<Link> linkOf(const std::string& key, const std::string& text, PeerCheck is_peer) {
  const auto address = mavlink::linkAddressOf(text);
  if (!address) {
    throw UserError(key + ": is not set in this configuration; set it to " +
                    std::string(mavlink::kLinkForms));
  }
  return makeLink(*address, std::move(is_peer));
}

}  // namespace redbee
