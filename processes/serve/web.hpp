// A request and its answer, without the sockets and the parsing of HTTP that cpp-httplib does.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace redbee {

struct WebRequest {
  std::string method;  ///< GET, POST
  std::string path;    ///< without the query
  std::map<std::string, std::string> query;
  std::map<std::string, std::string> headers;  ///< names in lower case

  /// Empty where there is none.
  std::string header(const std::string& name) const {
    const auto it = headers.find(name);
    return it == headers.end() ? "" : it->second;
  }
  std::string parameter(const std::string& name) const {
    const auto it = query.find(name);
    return it == query.end() ? "" : it->second;
  }
};

struct WebResponse {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
  std::filesystem::path file;  ///< whose first `file_bytes` are the body instead, unless empty
  size_t file_bytes = 0;
  std::shared_ptr<void> read_by;  ///< to be kept while the file is read
  bool is_event_stream = false;   ///< the server goes on with the events of Live
};

}  // namespace redbee
