// A request is bounded in bytes and in time, whoever sends it.
#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "tests/serve/served_page.hpp"

namespace redbee::test {
namespace {

using testing::StartsWith;

class HttpBounds : public ServedPage {
 protected:
  /// Sends until the server ends the connection, at most so often; returns how often.
  static int sendUntilEnded(int descriptor, const std::string& bytes, int most, int pause_ms = 0) {
    for (int i = 0; i < most; ++i) {
      if (send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0) return i;
      if (pause_ms > 0) std::this_thread::sleep_for(std::chrono::milliseconds(pause_ms));
    }
    return most;
  }
  void expectServing() const {
    EXPECT_THAT(answerTo(request("GET /", withToken() + "Connection: close\r\n")),
                StartsWith("HTTP/1.1 200 "));
  }
};

TEST_F(HttpBounds, TenThousandHeadersAreRefused) {
  std::string headers;
  for (int i = 0; i < 10'000; ++i) headers += "X-" + std::to_string(i) + ": 1\r\n";
  const int descriptor = connected();
  const std::string all = request("GET /", withToken() + "Connection: close\r\n" + headers);
  sendUntilEnded(descriptor, all, 1);
  char answer[16] = {};
  const ssize_t read = recv(descriptor, answer, sizeof answer - 1, 0);
  EXPECT_FALSE(read > 0 && std::string(answer).find(" 200 ") != std::string::npos) << answer;
  close(descriptor);
  expectServing();
}

TEST_F(HttpBounds, ALineOfAMegabyteIsRefused) {
  for (const std::string& begin : {request("GET /", withToken() + "X-Long: "), std::string("GET /")}) {
    const int descriptor = connected();
    sendUntilEnded(descriptor, begin.substr(0, begin.size() - 2), 1);
    EXPECT_LT(sendUntilEnded(descriptor, std::string(1024, 'x'), 1024), 1024) << begin;
    close(descriptor);
  }
  expectServing();
}

TEST_F(HttpBounds, HeadersWithoutAnEndAreRefused) {
  const int descriptor = connected();
  sendUntilEnded(descriptor, "GET / HTTP/1.1\r\nHost: localhost\r\n", 1);
  EXPECT_LT(sendUntilEnded(descriptor, "X-Header: 123456789\r\n", 1'000'000), 1'000'000);
  close(descriptor);
  expectServing();
}

/// As many as the server has threads, and more: each sends a byte now and then, and never ends its head.
TEST_F(HttpBounds, WhoDripsKeepsNobodyElseFromThePage) {
  std::vector<int> slow;
  for (int i = 0; i < 60; ++i) {
    slow.push_back(connected());
    sendUntilEnded(slow.back(), "GET / HTTP/1.1\r\nX-Slow: ", 1);
  }
  std::atomic<bool> is_over{false};
  std::thread dripping([&] {
    while (!is_over) {
      for (const int descriptor : slow) sendUntilEnded(descriptor, "x", 1);
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  });
  expectServing();
  is_over = true;
  dripping.join();
  for (const int descriptor : slow) close(descriptor);
}

TEST_F(HttpBounds, ManyRequestsOnOneConnectionAreAnswered) {
  const int descriptor = connected();
  const std::string one = request("GET /icon.svg", withToken());
  std::string answers;
  char part[4096];
  constexpr int kRequests = 100;  // more bytes than one request may have
  int begun = 0;
  for (int i = 0; i < kRequests; ++i) {
    ASSERT_EQ(sendUntilEnded(descriptor, one + std::string(), 1), 1);
    const std::string end = "</svg>";
    for (answers.clear(); answers.find(end) == std::string::npos;) {
      const ssize_t read = recv(descriptor, part, sizeof part, 0);
      ASSERT_GT(read, 0) << i;
      answers.append(part, static_cast<size_t>(read));
    }
    begun += answers.rfind("HTTP/1.1 200 ", 0) == 0 ? 1 : 0;
  }
  EXPECT_EQ(begun, kRequests);
  close(descriptor);
}

}  // namespace
}  // namespace redbee::test
