#include "redbee/mavlink/signing.hpp"

#include <nettle/sha2.h>

#include <algorithm>
#include <cctype>

namespace redbee::mavlink {
namespace {

constexpr int64_t kStart_us = 1'420'070'400'000'000;  // 2015-01-01 since 1970
constexpr size_t kStamp = 1 + 6;                      // link and timestamp
constexpr size_t kDigest = 6;
constexpr SigningTime kMask = (SigningTime{1} << 48) - 1;

/// `size`: of the frame up to and with the timestamp.
std::array<uint8_t, kDigest> digestOf(const SigningKey& key, const uint8_t* frame, size_t size) {
  sha256_ctx context{};
  sha256_init(&context);
  sha256_update(&context, key.size(), key.data());
  sha256_update(&context, size, frame);
  std::array<uint8_t, kDigest> digest{};
  sha256_digest(&context, digest.size(), digest.data());
  return digest;
}

int digitOf(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

}  // namespace

std::optional<SigningKey> signingKeyOf(std::string_view text) {
  const auto is_space = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  SigningKey key{};
  if (text.size() != 2 * key.size()) return std::nullopt;
  for (size_t i = 0; i < key.size(); ++i) {
    const int high = digitOf(text[2 * i]);
    const int low = digitOf(text[2 * i + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    key[i] = static_cast<uint8_t>(16 * high + low);
  }
  return key;
}

SigningTime signingTimeOf(int64_t utc_us) {
  return utc_us < kStart_us ? 0 : static_cast<SigningTime>((utc_us - kStart_us) / 10) & kMask;
}

void Signer::sign(Bytes& frame) {
  ++time_;
  frame.push_back(link_);
  for (int i = 0; i < 6; ++i) frame.push_back(static_cast<uint8_t>(time_ >> (8 * i)));
  const auto digest = digestOf(key_, frame.data(), frame.size());
  frame.insert(frame.end(), digest.begin(), digest.end());
}

bool SignatureCheck::accepts(const Frame& frame) {
  if (!frame.is_signed || frame.bytes.size() < kHeader2 + kChecksum + kSignature) return false;
  const size_t size = frame.bytes.size() - kDigest;
  const auto digest = digestOf(key_, frame.bytes.data(), size);
  // All bytes are compared: the time that it takes says nothing of the first wrong one.
  uint8_t difference = 0;
  for (size_t i = 0; i < kDigest; ++i) difference |= static_cast<uint8_t>(digest[i] ^ frame.bytes[size + i]);
  if (difference != 0) return false;
  const uint8_t* stamp = frame.bytes.data() + size - kStamp;
  SigningTime time = 0;
  for (int i = 0; i < 6; ++i) time |= SigningTime{stamp[1 + i]} << (8 * i);
  const Stream stream{frame.system, frame.component, stamp[0]};
  const auto known = latest_.find(stream);
  if (known != latest_.end() && time <= known->second) return false;
  if (known == latest_.end() && (time + kMaxAge < now_ || latest_.size() >= kMostStreams)) return false;
  latest_[stream] = time;
  advanceTo(time);
  return true;
}

}  // namespace redbee::mavlink
