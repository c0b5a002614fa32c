// What a browser may send to redbee-serve: path, query and headers, as cpp-httplib has split them. Lines of
// the input: the method, the path, then names and values, each pair of lines a parameter, or a header where
// the name begins with a colon.
#include "processes/serve/station.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/files/log.hpp"
#include "redbee/files/user_error.hpp"
#include "tests/fuzz/fuzz_input.hpp"
#include "tests/fuzz/small_vehicle.hpp"

namespace redbee::fuzz {
namespace {

std::vector<std::string> linesOf(const uint8_t* data, size_t size) {
  std::vector<std::string> lines(1);
  for (size_t i = 0; i < size; ++i) {
    if (data[i] == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += static_cast<char>(data[i]);
    }
  }
  return lines;
}

WebRequest requestOf(const std::vector<std::string>& lines) {
  WebRequest request;
  request.method = lines[0];
  if (lines.size() > 1) request.path = lines[1];
  for (size_t i = 2; i + 1 < lines.size(); i += 2) {
    const std::string& name = lines[i];
    if (!name.empty() && name[0] == ':') {
      request.headers[name.substr(1)] = lines[i + 1];
    } else {
      request.query[name] = lines[i + 1];
    }
  }
  return request;
}

std::filesystem::path writeFlight(const std::filesystem::path& file) {
  LogWriter log(file);
  for (int k = 0; k < 3; ++k)
    log.write("CAMERA", rawGreyMessage(1'000'000'000 + k * 40'000, cv::Mat1b(kHeight, kWidth, uchar{90})));
  log.close();
  return file;
}

}  // namespace
}  // namespace redbee::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace redbee;  // NOLINT: a target is one function
  static const fuzz::Folder folder;
  static const auto no_log = folder.write("flights/a.lcm", "no log");
  static const auto log = fuzz::writeFlight(folder / "flights/b.lcm");
  static const auto report = folder.write("flights/report.html", "<html></html>");
  static const Configuration configuration = fuzz::smallVehicle();
  static Live live;
  static Archive archive(configuration, {folder / "flights"});
  static LiveMosaic mosaic(configuration);
  const StackControl control{[] { return std::optional<bool>(); },
                             [](const std::string&, const std::string& process) {
                               if (process.find_first_of("<>&") != std::string::npos) abort();
                               return std::string();
                             }};
  const auto lines = fuzz::linesOf(data, size);
  const WebRequest request = fuzz::requestOf(lines);
  for (const char* token : {"", "0123456789abcdef"}) {
    Station station(Access(*listenAddressOf("127.0.0.1:1"), token, true), archive, live, control);
    station.showMosaic(mosaic);
    station.answer(request);
  }
  if (const auto address = listenAddressOf(lines[0]);
      address && address->unix_socket.empty() && address->port == 0)
    abort();
  return 0;
}
