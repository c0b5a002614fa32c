#include "processes/redbee/vehicle/recording_queue.hpp"

#include <gtest/gtest.h>

#include <future>
#include <stdexcept>

namespace redbee {
namespace {

ReceivedMessage numbered(int64_t utime) { return {utime, "A", std::vector<uint8_t>(1000)}; }

TEST(RecordingQueue, CloseWritesTheWholeQueueInOrder) {
  std::vector<int64_t> written;
  RecordingQueue queue([&](const ReceivedMessage& m) { written.push_back(m.utime); }, 1 << 20);
  std::vector<int64_t> pushed;
  for (int64_t k = 0; k < 500; ++k) {
    pushed.push_back(k);
    EXPECT_TRUE(queue.push(numbered(k)));
  }
  queue.close();
  EXPECT_EQ(written, pushed);
}

TEST(RecordingQueue, AStalledDiskCostsNothingUpToTheLimit) {
  std::promise<void> disk;
  std::shared_future<void> goes_on = disk.get_future().share();
  std::vector<int64_t> written;
  const int64_t room = 10;
  RecordingQueue queue(
      [&](const ReceivedMessage& m) {
        goes_on.wait();
        written.push_back(m.utime);
      },
      room * numbered(0).bytes());
  for (int64_t k = 0; k < room; ++k) EXPECT_TRUE(queue.push(numbered(k))) << k;
  EXPECT_FALSE(queue.push(numbered(room))) << "memory has an end";
  disk.set_value();
  queue.close();
  EXPECT_EQ(written.size(), static_cast<size_t>(room));
}

TEST(RecordingQueue, AFailureIsReportedAndEndsTheQueue) {
  RecordingQueue queue([](const ReceivedMessage&) { throw std::runtime_error("disk full"); }, 1 << 20);
  queue.push(numbered(1));
  queue.close();
  EXPECT_EQ(queue.failure(), "disk full");
  EXPECT_FALSE(queue.push(numbered(2)));
}

}  // namespace
}  // namespace redbee
