// What the server does with requests before their bodies, and with answers of any size: over a socket.
#include <gmock/gmock.h>

#include "tests/serve/served_page.hpp"

namespace redbee::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

using HttpRefusal = ServedPage;

TEST_F(HttpRefusal, WithoutTheTokenNoBodyIsWaitedFor) {
  const std::string answer = answerTo(request("POST /api/record?on=1", "Content-Length: 4000000000\r\n"));
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 401 "));
  EXPECT_THAT(answer, HasSubstr("the token is missing"));
}

TEST_F(HttpRefusal, ABodyOfUnknownOrGreatLengthIsNotRead) {
  for (const char* length : {"Content-Length: 4000000000\r\n", "Transfer-Encoding: chunked\r\n"}) {
    const std::string answer =
        answerTo(request("POST /api/record?on=1", withToken() + "X-Redbee: 1\r\n" + length));
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 413 ")) << length;
    EXPECT_THAT(answer, EndsWith("no request to this page has such a body\n")) << length;
  }
}

TEST_F(HttpRefusal, EveryErrorHasALine) {
  for (const char* line : {"PUT /", "DELETE /api/record", "BREW /"}) {
    const std::string answer = answerTo(request(line, withToken() + "Connection: close\r\nX-Redbee: 1\r\n"));
    const size_t body = answer.find("\r\n\r\n");
    ASSERT_NE(body, std::string::npos) << line;
    EXPECT_GT(answer.size(), body + 4) << line << ": " << answer;
  }
}

/// Of a range that the client names, the server sends nothing that lies behind the answer in its memory.
TEST_F(HttpRefusal, AnAnswerIsSentWholeWhateverRangeIsAskedFor) {
  const std::string close = "Connection: close\r\n";
  const std::string token = withToken();
  for (const char* line : {"GET /", "GET /icon.svg", "GET /report?name=flights/none.html"}) {
    for (const std::string& access : {std::string(), token}) {
      const std::string whole = answerTo(request(line, access + close));
      for (const char* range :
           {"1-4000", "1-1,0-100000", "4000-5000", "-9999", "9-", "0-9223372036854775806"}) {
        const std::string answer = answerTo(request(line, access + close + "Range: bytes=" + range + "\r\n"));
        EXPECT_EQ(answer, whole) << line << " " << range;
      }
    }
  }
}

TEST_F(HttpRefusal, AReportComesWhole) {
  const std::string answer =
      answerTo(request("GET /report?name=flights/report.html", withToken() + "Connection: close\r\n"));
  EXPECT_THAT(answer.substr(0, 15), StartsWith("HTTP/1.1 200 "));
  EXPECT_EQ(answer.size() - answer.find("\r\n\r\n") - 4, 3'000'003U);
  EXPECT_EQ(answer.substr(answer.size() - 4), "xend");
  EXPECT_THAT(answer.substr(0, 600), HasSubstr("sandbox"));
}

}  // namespace
}  // namespace redbee::test
