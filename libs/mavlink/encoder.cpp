#include "redbee/mavlink/encoder.hpp"

#include "redbee/mavlink/crc.hpp"

namespace redbee::mavlink {

Bytes Encoder::frameOf(const MessageLayout& layout, Bytes payload) {
  while (payload.size() > 1 && payload.back() == 0) payload.pop_back();
  const uint8_t flags = signer_ ? kSigned : 0;
  Bytes frame{kMagic2,
              static_cast<uint8_t>(payload.size()),
              flags,
              0,
              sequence_++,
              system_,
              component_,
              static_cast<uint8_t>(layout.id),
              static_cast<uint8_t>(layout.id >> 8),
              static_cast<uint8_t>(layout.id >> 16)};
  frame.insert(frame.end(), payload.begin(), payload.end());
  const uint16_t crc = crcOf(layout.crc_extra, crcOf(frame.data() + 1, frame.size() - 1, kCrcStart));
  frame.push_back(static_cast<uint8_t>(crc));
  frame.push_back(static_cast<uint8_t>(crc >> 8));
  if (signer_) signer_->sign(frame);
  return frame;
}

}  // namespace redbee::mavlink
