#include "redbee/mavlink/signing.hpp"

#include <gtest/gtest.h>

#include "redbee/mavlink/encoder.hpp"
#include "redbee/mavlink/messages.hpp"
#include "redbee/mavlink/parser.hpp"
#include "tests/mavlink/vectors.hpp"

namespace redbee::mavlink {
namespace {

constexpr int64_t k2026_us = 1'767'225'600'000'000;

SigningKey theKey() { return *signingKeyOf(vectors::kKey); }
Frame frameOf(const Bytes& bytes) {
  Parser parser;
  parser.feed(bytes.data(), bytes.size());
  return parser.next().value();
}

TEST(MavlinkSigning, TimeCountsFrom2015) {
  EXPECT_EQ(signingTimeOf(k2026_us), 34'715'520'000'000U);
  EXPECT_EQ(signingTimeOf(0), 0U);
}

TEST(MavlinkSigning, AcceptsTheSignatureOfAnother) {
  SignatureCheck check(theKey(), signingTimeOf(k2026_us));
  EXPECT_TRUE(check.accepts(frameOf(vectors::bytesOf(vectors::kSignedHeartbeat))));
}

TEST(MavlinkSigning, WritesTheSignatureOfAnother) {
  Encoder encoder(1, 191);
  encoder.signWith(Signer(theKey(), 0, signingTimeOf(k2026_us) - 1));
  EXPECT_EQ(encoder.encode(Heartbeat{0, 18, 8, 0, 4, 3}), vectors::bytesOf(vectors::kOurSignedHeartbeat));
}

TEST(MavlinkSigning, RefusesWhatWasChangedOrRepeated) {
  const Bytes good = vectors::bytesOf(vectors::kSignedHeartbeat);
  SignatureCheck check(theKey(), signingTimeOf(k2026_us));
  for (size_t at = good.size() - kSignature; at < good.size(); ++at) {
    Bytes bad = good;
    bad[at] ^= 1;
    EXPECT_FALSE(check.accepts(frameOf(bad))) << at;
  }
  EXPECT_TRUE(check.accepts(frameOf(good)));
  EXPECT_FALSE(check.accepts(frameOf(good)));
  EXPECT_FALSE(check.accepts(frameOf(vectors::bytesOf(vectors::kHeartbeat2))));
}

TEST(MavlinkSigning, RefusesAnotherKey) {
  SigningKey key = theKey();
  key[31] ^= 1;
  SignatureCheck check(key, signingTimeOf(k2026_us));
  EXPECT_FALSE(check.accepts(frameOf(vectors::bytesOf(vectors::kSignedHeartbeat))));
}

TEST(MavlinkSigning, ANewSenderMayBeAMinuteOld) {
  const Frame frame = frameOf(vectors::bytesOf(vectors::kSignedHeartbeat));
  const SigningTime sent = signingTimeOf(k2026_us);
  EXPECT_TRUE(SignatureCheck(theKey(), sent + SignatureCheck::kMaxAge).accepts(frame));
  EXPECT_FALSE(SignatureCheck(theKey(), sent + SignatureCheck::kMaxAge + 1).accepts(frame));
}

TEST(MavlinkSigning, OurTimesIncrease) {
  Encoder encoder(1, 191);
  encoder.signWith(Signer(theKey(), 0, 1000));
  SignatureCheck check(theKey(), 0);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(check.accepts(frameOf(encoder.encode(Heartbeat{}))));
  EXPECT_EQ(check.time(), 1005U);
}

TEST(MavlinkSigning, AKeyIs64HexadecimalDigits) {
  const std::string digits(vectors::kKey);
  EXPECT_TRUE(signingKeyOf(" " + digits + "\n"));
  EXPECT_FALSE(signingKeyOf(digits.substr(1)));
  EXPECT_FALSE(signingKeyOf(digits + "0"));
  EXPECT_FALSE(signingKeyOf("g" + digits.substr(1)));
  EXPECT_FALSE(signingKeyOf(""));
}

}  // namespace
}  // namespace redbee::mavlink
