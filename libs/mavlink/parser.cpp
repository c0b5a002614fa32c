#include "redbee/mavlink/parser.hpp"

#include <algorithm>

#include "redbee/mavlink/crc.hpp"

namespace redbee::mavlink {

void Parser::feed(const uint8_t* data, size_t size) {
  compact();
  buffer_.insert(buffer_.end(), data, data + size);
}

void Parser::compact() {
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin_));
  damaged_until_ = damaged_until_ > begin_ ? damaged_until_ - begin_ : 0;
  begin_ = 0;
}

void Parser::skip(size_t bytes) { begin_ += bytes; }

size_t Parser::lengthHere() const {
  const size_t size = buffer_.size() - begin_;
  const uint8_t* here = buffer_.data() + begin_;
  if (size < 2) return 0;
  if (here[0] == kMagic1) return kHeader1 + here[1] + kChecksum;
  if (size < 3) return 0;
  return kHeader2 + here[1] + kChecksum + ((here[2] & kSigned) != 0 ? kSignature : 0);
}

Parser::Verdict Parser::check(Frame& frame) const {
  const size_t length = lengthHere();
  if (length == 0 || begin_ + length > buffer_.size()) return Verdict::kIncomplete;
  const uint8_t* here = buffer_.data() + begin_;
  const bool is_version2 = here[0] == kMagic2;
  const uint8_t* from = here + (is_version2 ? 4 : 2);
  frame.sequence = from[0];
  frame.system = from[1];
  frame.component = from[2];
  frame.id = is_version2 ? from[3] | uint32_t{from[4]} << 8 | uint32_t{from[5]} << 16 : from[3];
  frame.payload_at = is_version2 ? kHeader2 : kHeader1;
  frame.payload_size = here[1];
  frame.is_signed = is_version2 && (here[2] & kSigned) != 0;
  const auto layout = layoutOf(frame.id);
  if (!layout || (is_version2 && (here[2] & ~kSigned) != 0)) return Verdict::kUnknown;
  const size_t end = frame.payload_at + frame.payload_size;
  const uint16_t crc = crcOf(layout->crc_extra, crcOf(here + 1, end - 1, kCrcStart));
  if (here[end] != (crc & 0xff) || here[end + 1] != crc >> 8) return Verdict::kWrong;
  // MAVLink 1 leaves out no zeros.
  if (!is_version2 && frame.payload_size < layout->min_length) return Verdict::kWrong;
  frame.bytes.assign(here, here + length);
  return Verdict::kFrame;
}

void Parser::countWrong(Verdict verdict) {
  if (begin_ < damaged_until_) return;
  if (verdict == Verdict::kWrong) ++counters_.crc_errors;
  if (verdict == Verdict::kUnknown) ++counters_.unknown;
  damaged_until_ = begin_ + std::max<size_t>(lengthHere(), 1);
}

std::optional<Frame> Parser::next() {
  while (begin_ < buffer_.size()) {
    const uint8_t magic = buffer_[begin_];
    Frame frame;
    const Verdict verdict = magic == kMagic1 || magic == kMagic2 ? check(frame) : Verdict::kWrong;
    if (verdict == Verdict::kIncomplete && !is_ended_) return std::nullopt;
    if (verdict == Verdict::kFrame) {
      skip(frame.bytes.size());
      ++counters_.frames;
      return frame;
    }
    if (magic == kMagic1 || magic == kMagic2) countWrong(verdict);
    ++counters_.noise;
    skip(1);
  }
  is_ended_ = false;
  return std::nullopt;
}

}  // namespace redbee::mavlink
