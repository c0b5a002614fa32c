// Many who connect and do not go on, and a disk that does not answer: the page is there for the others.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <thread>
#include <vector>

#include "redbee/bus/image.hpp"
#include "redbee/files/log.hpp"
#include "redbee/files/new_file.hpp"
#include "tests/serve/served_page.hpp"
#include "tests/support/camera.hpp"

namespace redbee::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// Each keeps a thread of the server for 5 s where nothing else ends it: 700 would keep the 48 for longer
/// than the one waits who asks last.
constexpr int kCrowd = 700;
constexpr time_t kPatience_s = 60;

class CrowdedPage : public ServedPage {
 protected:
  void TearDown() override {
    for (const int descriptor : crowd_) close(descriptor);
  }
  /// So many that send this and go no further.
  void gather(int connections, const std::string& bytes) {
    for (int i = 0; i < connections; ++i) {
      crowd_.push_back(connected());
      if (!bytes.empty()) send(crowd_.back(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    }
  }
  /// Both ends of the crowd are this process'.
  static bool mayOpen(int descriptors) {
    rlimit limit{};
    getrlimit(RLIMIT_NOFILE, &limit);
    limit.rlim_cur = limit.rlim_max;
    return limit.rlim_max > static_cast<rlim_t>(descriptors) && setrlimit(RLIMIT_NOFILE, &limit) == 0;
  }
  /// Empty: nothing for as long as anybody waits.
  std::string answerInTime(const std::string& path) const {
    const int descriptor = connected();
    const timeval patience{kPatience_s, 0};
    setsockopt(descriptor, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    const std::string asked = request("GET " + path, withToken() + "Connection: close\r\n");
    send(descriptor, asked.data(), asked.size(), MSG_NOSIGNAL);
    return restOf(descriptor);
  }

  std::vector<int> crowd_;
};

TEST_F(CrowdedPage, IsThereBehindManyWhoSayNothing) {
  if (!mayOpen(3 * kCrowd)) GTEST_SKIP() << "too few descriptors";
  gather(kCrowd, "");
  EXPECT_THAT(answerInTime("/"), StartsWith("HTTP/1.1 200 "));
}

TEST_F(CrowdedPage, IsThereBehindManyWhoStopInTheMiddleOfTheirRequest) {
  if (!mayOpen(3 * kCrowd)) GTEST_SKIP() << "too few descriptors";
  gather(kCrowd, "GET / HTTP/1.1\r\nX-Slow: ");
  EXPECT_THAT(answerInTime("/"), StartsWith("HTTP/1.1 200 "));
}

TEST_F(CrowdedPage, IsThereBehindManyWhoReadNothing) {
  if (!mayOpen(3 * kCrowd)) GTEST_SKIP() << "too few descriptors";
  gather(kCrowd, request("GET /report?name=flights/report.html", withToken()));
  EXPECT_THAT(answerInTime("/"), StartsWith("HTTP/1.1 200 "));
}

/// Alone, the same connections stay.
TEST_F(CrowdedPage, KeepsAConnectionThatNobodyElseWaitsFor) {
  gather(1, request("GET /icon.svg", withToken()));
  std::string answer;
  for (char part[4096]; answer.find("</svg>") == std::string::npos;) {
    const ssize_t n = recv(crowd_[0], part, sizeof part, 0);
    ASSERT_GT(n, 0);
    answer.append(part, static_cast<size_t>(n));
  }
  std::this_thread::sleep_for(std::chrono::seconds(1));
  pollfd end{crowd_[0], POLLIN, 0};
  EXPECT_EQ(poll(&end, 1, 0), 0) << "it was ended, or sent something that nobody asked for";
}

/// There is a thread for each of them, and one for who comes.
TEST_F(CrowdedPage, KeepsIdleConnectionsWhileThreadsAreFree) {
  gather(20, "");
  const auto begin = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - begin < std::chrono::seconds(1))
    ASSERT_THAT(answerInTime("/icon.svg"), StartsWith("HTTP/1.1 200 "));
  for (const int descriptor : crowd_) {
    pollfd end{descriptor, POLLIN, 0};
    EXPECT_EQ(poll(&end, 1, 0), 0) << "it was ended";
  }
}

/// More than there are threads ask for a flight whose file cannot be opened for now.
TEST_F(CrowdedPage, IsThereWhileTheDiskDoesNotAnswer) {
  const auto file = folder_ / "flights/slow.lcm";
  LogWriter log(file);
  log.write("CAMERA", rawGreyMessage(1'000'000'000, cv::Mat1b(kHeight, kWidth, uchar{90})));
  log.close();
  std::signal(SIGIO, SIG_IGN);
  const FileDescriptor lease(open(file.c_str(), O_RDWR | O_CLOEXEC));
  if (fcntl(lease.get(), F_SETLEASE, F_WRLCK) != 0) GTEST_SKIP() << "no leases in this folder";
  gather(1, request("GET /api/flight?name=flights/slow.lcm", withToken()));
  // F_GETLEASE says F_UNLCK as soon as somebody waits.
  pollfd first{crowd_[0], POLLIN, 0};
  while (fcntl(lease.get(), F_GETLEASE) == F_WRLCK)
    ASSERT_EQ(poll(&first, 1, 10), 0) << "it is answered without that file";
  gather(60, request("GET /api/flight?name=flights/slow.lcm", withToken()));
  EXPECT_THAT(answerInTime("/api/frame?after=0"), StartsWith("HTTP/1.1 204 "));
  EXPECT_THAT(answerInTime("/api/flights"), HasSubstr("still being answered from the disk"));
  EXPECT_EQ(poll(&first, 1, 0), 0) << "the disk has answered meanwhile: nothing is tested";
  EXPECT_EQ(fcntl(lease.get(), F_SETLEASE, F_UNLCK), 0);
  EXPECT_EQ(poll(&first, 1, 1000 * kPatience_s), 1);
  EXPECT_THAT(answerInTime("/api/flights"), HasSubstr("flights/slow.lcm")) << "as soon as it answers again";
}

}  // namespace
}  // namespace redbee::test
