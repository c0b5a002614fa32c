#include "redbee/bus/receive_buffer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace redbee {
namespace {

using testing::HasSubstr;

TEST(ReceiveBuffer, IsReadFromTheOptionsOfTheUrl) {
  EXPECT_EQ(receiveBufferOf(kDefaultLcmUrl), kRecommendedReceiveBuffer);
  EXPECT_EQ(receiveBufferOf("udpm://1.2.3.4:5?recv_buf_size=7&ttl=0"), 7);
  EXPECT_EQ(receiveBufferOf("udpm://1.2.3.4:5?ttl=0&recv_buf_size=7"), 7);
  EXPECT_EQ(receiveBufferOf("udpm://1.2.3.4:5?ttl=0"), std::nullopt);
  EXPECT_EQ(receiveBufferOf("udpm://1.2.3.4:5"), std::nullopt);
  EXPECT_EQ(receiveBufferOf("udpm://1.2.3.4:5?recv_buf_size=lots"), std::nullopt);
  EXPECT_EQ(receiveBufferOf("udpm://1.2.3.4:5?recv_buf_size=-5"), std::nullopt);
  EXPECT_EQ(receiveBufferOf("udpm://1.2.3.4:5?my_recv_buf_size=5"), std::nullopt);
}

TEST(ReceiveBuffer, AKernelThatGrantsItIsEnough) {
  EXPECT_TRUE(checkReceiveBuffer(kDefaultLcmUrl, 4194304).enough);
  EXPECT_TRUE(checkReceiveBuffer(kDefaultLcmUrl, std::nullopt).enough) << "an unknown limit accuses nobody";
}

TEST(ReceiveBuffer, AKernelThatCapsItIsToBeFixed) {
  const auto check = checkReceiveBuffer(kDefaultLcmUrl, 212992);
  EXPECT_FALSE(check.enough);
  EXPECT_THAT(check.advice, HasSubstr("sysctl -w net.core.rmem_max=4194304"));
  EXPECT_THAT(check.advice, HasSubstr("212992"));
}

TEST(ReceiveBuffer, AUrlThatRequestsTooLittleIsToBeFixed) {
  for (const char* url :
       {"udpm://239.255.76.67:7667?ttl=0", "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=1000"}) {
    const auto check = checkReceiveBuffer(url, 4194304);
    EXPECT_FALSE(check.enough);
    EXPECT_THAT(check.advice, HasSubstr("recv_buf_size=4194304"));
  }
}

TEST(ReceiveBuffer, MemoryNeedsNone) { EXPECT_TRUE(checkReceiveBuffer("memq://", 0).enough); }

}  // namespace
}  // namespace redbee
