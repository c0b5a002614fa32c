// A frame of MAVLink 1 or 2, as it is on the wire (mavlink.io/en/guide/serialization.html).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "redbee/mavlink/message_fields.hpp"

namespace redbee::mavlink {

using Bytes = std::vector<uint8_t>;

inline constexpr uint8_t kMagic1 = 0xfe;
inline constexpr uint8_t kMagic2 = 0xfd;
inline constexpr uint8_t kSigned = 0x01;  ///< the only one of the incompatibility flags that is defined
inline constexpr size_t kHeader1 = 6;     ///< bytes, with the magic
inline constexpr size_t kHeader2 = 10;
inline constexpr size_t kChecksum = 2;
inline constexpr size_t kSignature = 13;

struct Frame {
  uint8_t sequence = 0;
  uint8_t system = 0;
  uint8_t component = 0;
  uint32_t id = 0;
  bool is_signed = false;  ///< carries a signature, which may be wrong
  Bytes bytes;             ///< the whole frame
  size_t payload_at = 0;
  size_t payload_size = 0;  ///< as sent: without the zeros at its end

  template <typename Message>
  Message message() const {
    return messageFrom<Message>(bytes.data() + payload_at, payload_size);
  }
};

}  // namespace redbee::mavlink
