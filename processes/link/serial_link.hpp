// A serial port, or any terminal that behaves like one (termios): eight bits, no parity, one stop bit, no
// flow control.
#pragma once

#include <termios.h>

#include <string>
#include <vector>

#include "processes/link/link.hpp"
#include "redbee/files/new_file.hpp"

namespace redbee {

class SerialLink : public Link {
 public:
  /// Throws UserError for a speed that there is not.
  SerialLink(std::string device, uint32_t baud);
  std::string open() override;
  bool isOpen() const override { return file_.isOpen(); }
  ReceivedBytes receive(std::chrono::milliseconds timeout) override;
  bool send(const std::vector<uint8_t>& data) override;
  bool isDatagram() const override { return false; }

 private:
  std::string device_;
  speed_t speed_;
  FileDescriptor file_;
};

}  // namespace redbee
