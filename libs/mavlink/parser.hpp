// Finds the frames in a stream of bytes, of which any may be lost or wrong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "redbee/mavlink/frame.hpp"
#include "redbee/mavlink/message_table.hpp"

namespace redbee::mavlink {

struct ParserCounters {
  int64_t frames = 0;      ///< with a right checksum
  int64_t crc_errors = 0;  ///< of messages that are known; one for each stretch of damage
  int64_t unknown = 0;     ///< of another dialect, or with flags that are not understood: cannot be checked
  int64_t noise = 0;       ///< bytes that belong to no frame
};

/// A frame is believed by its checksum alone. Where it is wrong, the search goes on at the next byte, not
/// behind the frame, whose length may be what is wrong: damage costs the frames that it touches and no other.
class Parser {
 public:
  void feed(const uint8_t* data, size_t size);
  /// The next whole frame; std::nullopt if more bytes are needed. To be called until then after each feed().
  std::optional<Frame> next();
  /// Frames do not continue in the next datagram, or after the device was opened again: what is incomplete
  /// will stay so. next() then finds what lies behind it.
  void endOfDatagram() { is_ended_ = true; }
  const ParserCounters& counters() const { return counters_; }

 private:
  enum class Verdict { kFrame, kWrong, kUnknown, kIncomplete };
  Verdict check(Frame& frame) const;
  /// Length of the frame that would begin here; 0 where the header is incomplete.
  size_t lengthHere() const;
  void skip(size_t bytes);
  void compact();
  void countWrong(Verdict verdict);

  Bytes buffer_;
  size_t begin_ = 0;
  size_t damaged_until_ = 0;  ///< end of a frame that was wrong: what else is wrong in it was counted with it
  bool is_ended_ = false;
  ParserCounters counters_;
};

}  // namespace redbee::mavlink
