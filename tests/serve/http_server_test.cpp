// Where the page is served: one server at an address, and bad use in one line.
#include "processes/serve/http_server.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "processes/serve/run_serve.hpp"
#include "redbee/files/new_file.hpp"
#include "redbee/files/user_error.hpp"
#include "redbee/node/node.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

using testing::HasSubstr;

/// A port of the loopback that nobody has at the moment.
uint16_t freePort() {
  const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  EXPECT_EQ(bind(descriptor, reinterpret_cast<const sockaddr*>(&address), size), 0);
  EXPECT_EQ(getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size), 0);
  close(descriptor);
  return ntohs(address.sin_port);
}

class HttpServerTest : public testing::Test {
 protected:
  std::unique_ptr<HttpServer> serverAt(const std::string& address) {
    return std::make_unique<HttpServer>(*listenAddressOf(address), station_, live_);
  }
  /// Empty: none.
  std::string faultAt(const std::string& address) {
    try {
      serverAt(address);
      return "";
    } catch (const UserError& error) {
      return error.what();
    }
  }

  /// Has an event stream that has begun.
  static FileDescriptor viewerAt(const std::string& file) {
    FileDescriptor viewer(socket(AF_UNIX, SOCK_STREAM, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    file.copy(address.sun_path, sizeof address.sun_path - 1);
    EXPECT_EQ(connect(viewer.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    const std::string request = "GET /api/events HTTP/1.1\r\nHost: localhost\r\n\r\n";
    EXPECT_EQ(send(viewer.get(), request.data(), request.size(), 0), static_cast<ssize_t>(request.size()));
    std::string answer;
    char part[4096];
    for (ssize_t n = 0;
         answer.find("retry: ") == std::string::npos && (n = recv(viewer.get(), part, sizeof part, 0)) > 0;)
      answer.append(part, static_cast<size_t>(n));
    EXPECT_THAT(answer, HasSubstr("retry: "));
    return viewer;
  }

  ScratchFolder folder_;
  Live live_;
  Archive archive_{Configuration(), {}};
  Station station_{Access(*listenAddressOf("127.0.0.1:1"), "", false), archive_, live_, supervisedStack()};
};

TEST_F(HttpServerTest, APortHasOneServer) {
  const std::string address = "127.0.0.1:" + std::to_string(freePort());
  const auto first = serverAt(address);
  EXPECT_THAT(faultAt(address), HasSubstr("Address already in use"));
}

TEST_F(HttpServerTest, AUnixSocketHasOneServer) {
  const std::string file = (folder_ / "serve.sock").string();
  auto first = serverAt("unix:" + file);
  EXPECT_THAT(faultAt("unix:" + file), HasSubstr(file + ": another server listens there"));
  EXPECT_TRUE(fs::is_socket(file));
  first.reset();
  ASSERT_TRUE(fs::is_socket(file)) << "the next server is to find it";
  EXPECT_EQ(faultAt("unix:" + file), "");
}

TEST_F(HttpServerTest, AFileIsNotReplacedByASocket) {
  writeText(folder_ / "notes", "mine");
  EXPECT_NE(faultAt("unix:" + (folder_ / "notes").string()), "");
  EXPECT_EQ(readText(folder_ / "notes"), "mine");
}

/// Whatever ends its listening: the process ends with it, and is started again, also where somebody watches.
TEST_F(HttpServerTest, AServerThatNobodyCanReachAnyMoreEndsItsProcess) {
  const std::atomic<bool>& stop = stopOnSignals();
  ASSERT_FALSE(stop);
  const std::string file = (folder_ / "serve.sock").string();
  const auto server = serverAt("unix:" + file);
  const FileDescriptor viewer = viewerAt(file);
  int found = 0;
  for (int descriptor = 3; descriptor < 1024; ++descriptor) {
    int listens = 0;
    socklen_t size = sizeof listens;
    if (getsockopt(descriptor, SOL_SOCKET, SO_ACCEPTCONN, &listens, &size) != 0 || listens == 0) continue;
    shutdown(descriptor, SHUT_RDWR);  // accept() fails from now on
    ++found;
  }
  ASSERT_EQ(found, 1);
  for (int i = 0; i < 6000 && !stop; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(stop);
}

TEST(Serve, SaysWhichFolderOfFlightsThereIsNot) {
  const ScratchFolder folder;
  writeText(folder / "file", "");
  writeText(folder / "vehicle.yaml", "");
  for (const char* name : {"file", "none"}) {
    std::vector<std::string> words{
        "redbee-serve", "--config", (folder / "vehicle.yaml").string(), "--flights", (folder / name).string(),
        "--listen",     "nowhere"};  // or it would serve, where this is not refused
    std::vector<char*> arguments(words.size());
    std::transform(words.begin(), words.end(), arguments.begin(),
                   [](std::string& word) { return word.data(); });
    testing::internal::CaptureStderr();
    const int code = runServe(static_cast<int>(arguments.size()), arguments.data());
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_EQ(code, 2);
    EXPECT_THAT(said, HasSubstr("--flights " + (folder / name).string() + ": "));
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  }
}

TEST(Live, HasNoMoreViewersThanTheServerHasThreadsFor) {
  constexpr int kThreads = 4;
  constexpr int kRounds = 20'000;
  Live live;
  std::vector<Live::Viewer> seated;
  for (int i = 0; i + 1 < Live::kMostViewers; ++i) seated.push_back(std::move(*live.join()));
  std::atomic<int> overbooked{0};
  std::vector<std::thread> threads;
  threads.reserve(kThreads);
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&] {
      for (int k = 0; k < kRounds; ++k) {
        const auto last = live.join();
        const int viewers = live.viewers();
        if (viewers > Live::kMostViewers) ++overbooked;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(overbooked, 0);
  EXPECT_EQ(live.viewers(), Live::kMostViewers - 1);
}

}  // namespace
}  // namespace redbee::test
