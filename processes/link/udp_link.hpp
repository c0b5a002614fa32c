// MAVLink in datagrams.
#pragma once

#include <netinet/in.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "processes/link/link.hpp"
#include "redbee/files/new_file.hpp"

namespace redbee {

/// One peer: the address that is spoken to, or the first whose datagram passes the check, until none of its
/// own has passed for three seconds. Others are not listened to, nor answered.
class UdpLink : public Link {
 public:
  /// `address`: IPv4, to listen on or to speak to.
  UdpLink(const std::string& address, uint16_t port, bool listens, PeerCheck check = {});
  std::string open() override;
  bool isOpen() const override { return socket_.isOpen(); }
  ReceivedBytes receive(std::chrono::milliseconds timeout) override;
  bool send(const std::vector<uint8_t>& data) override;
  bool isDatagram() const override { return true; }

 private:
  bool isPeer(const sockaddr_in& from, const std::vector<uint8_t>& datagram, int64_t now_ns);

  std::string name_;  ///< for messages
  sockaddr_in address_{};
  bool listens_;
  PeerCheck check_;
  FileDescriptor socket_;
  std::optional<sockaddr_in> peer_;
  int64_t heard_ns_ = 0;
};

}  // namespace redbee
