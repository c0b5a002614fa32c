#include "processes/serve/station.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "processes/health_check.hpp"
#include "processes/serve/page_files.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/files/user_error.hpp"

namespace redbee {
namespace {

using nlohmann::json;

WebResponse plain(int status, const std::string& text) {
  WebResponse response;
  response.status = status;
  response.body = text + "\n";
  return response;
}

WebResponse jsonResponse(const json& content) {
  WebResponse response;
  response.type = "application/json";
  response.body = textOf(content);
  return response;
}

WebResponse bytesResponse(std::string bytes) {
  WebResponse response;
  response.type = "application/octet-stream";
  response.body = std::move(bytes);
  return response;
}

std::string typeOf(std::string_view name) {
  const std::string_view ending = name.substr(std::min(name.rfind('.'), name.size()));
  if (ending == ".html") return "text/html; charset=utf-8";
  if (ending == ".css") return "text/css; charset=utf-8";
  if (ending == ".js") return "text/javascript; charset=utf-8";
  return "image/svg+xml";
}

std::optional<WebResponse> pageFile(const std::string& path) {
  const std::string name = path == "/" ? "index.html" : path.substr(std::min<size_t>(1, path.size()));
  for (const PageFile& file : pageFiles()) {
    if (file.name != name) continue;
    WebResponse response;
    response.type = typeOf(name);
    response.body = std::string(file.content);
    // Nothing of another address; the images come as blobs.
    response.headers.emplace_back("Content-Security-Policy",
                                  "default-src 'self'; img-src 'self' blob:; frame-ancestors 'none'");
    return response;
  }
  return std::nullopt;
}

json entryJson(const Archive::Entry& entry) {
  return {{"name", entry.name},
          {"bytes", entry.bytes},
          {"modified", entry.modified_s},
          {"parts", entry.files.size()}};
}

json entriesJson(const std::vector<Archive::Entry>& entries) {
  json result = json::array();
  for (const Archive::Entry& entry : entries) result.push_back(entryJson(entry));
  return result;
}

}  // namespace

std::optional<int64_t> numberOf(const std::string& text) {
  int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || end != text.data() + text.size() || number < 0)
    return std::nullopt;
  return number;
}

Station::Station(Access access, Archive& archive, Live& live, StackControl control)
    : access_(std::move(access)), archive_(archive), live_(live), control_(std::move(control)) {}

WebResponse Station::answer(const WebRequest& request) {
  try {
    if (auto refused = access_.refusal(request)) return *refused;
    return route(request);
  } catch (const UserError& error) {
    return plain(422, error.what());
  } catch (const std::exception& error) {
    return plain(500, std::string("internal error: ") + error.what());
  }
}

std::optional<WebResponse> Station::refusal(const WebRequest& request) const {
  if (request.header("transfer-encoding").empty() && request.header("content-length").size() < 5)
    return access_.refusal(request);
  if (auto refused = access_.refusal(request)) return refused;
  return plain(413, "no request to this page has such a body");
}

WebResponse Station::route(const WebRequest& request) {
  if (request.method == "POST") return write(request);
  if (request.method != "GET") return plain(405, "GET and POST only");
  if (request.path == "/api/events") {
    WebResponse response;
    response.type = "text/event-stream";
    response.is_event_stream = true;
    return response;
  }
  if (request.path == "/api/frame") return liveFrame(request);
  if (request.path == "/api/mosaic") return liveMosaic(request);
  if (request.path == "/api/state") return state();
  if (auto file = pageFile(request.path)) return *file;
  return fromDisk(request);
}

/// The disk may stall, and a client may read its file slowly: both keep a thread from others.
WebResponse Station::fromDisk(const WebRequest& request) {
  static const std::map<std::string, WebResponse (Station::*)(const WebRequest&)> addresses{
      {"/api/flights", &Station::flights},          {"/api/flight", &Station::flight},
      {"/api/flight/frame", &Station::flightFrame}, {"/report", &Station::report},
      {"/api/tiles", &Station::tileLevels},         {"/api/tile", &Station::tile}};
  const auto address = addresses.find(request.path);
  if (address == addresses.end()) return plain(404, "no such address");
  const DiskGate::Ticket ticket = disk_.enter();
  if (!ticket) return plain(503, "too many requests are still being answered from the disk: try again later");
  WebResponse response = (this->*address->second)(request);
  if (!response.file.empty()) response.read_by = ticket;
  return response;
}

WebResponse Station::liveFrame(const WebRequest& request) const {
  const auto after = numberOf(request.parameter("after"));
  if (!after) return plain(400, "after: must be the number of a frame");
  const auto frame = live_.frame();
  // Another number than the newest: older, or that of a server before a restart.
  if (!frame || frame->sequence() == *after) return plain(204, "");
  return bytesResponse(frame->bundle());
}

WebResponse Station::liveMosaic(const WebRequest& request) const {
  const auto after = numberOf(request.parameter("after"));
  if (!after) return plain(400, "after: must be the number of a mosaic");
  const auto newest =
      mosaic_ == nullptr ? nullptr : mosaic_->newest(*after, std::chrono::steady_clock::now());
  return newest ? bytesResponse(*newest) : plain(204, "");
}

WebResponse Station::state() const {
  const auto recording = control_.is_recording();
  json content{{"writes", access_.allowsWrites()}, {"supervised", recording.has_value()}};
  content["recording"] = recording.value_or(false);
  return jsonResponse(content);
}

WebResponse Station::flights(const WebRequest&) {
  return jsonResponse(
      {{"flights", entriesJson(archive_.flights())}, {"reports", entriesJson(archive_.reports())}});
}

WebResponse Station::flight(const WebRequest& request) {
  const auto flight = archive_.open(request.parameter("name"), true);
  if (!flight) return plain(404, "no such flight");
  json times = json::array();
  for (size_t k = 0; k < flight->frames(); ++k) times.push_back(flight->utime(k) - flight->utime(0));
  return jsonResponse({{"first", flight->utime(0)},
                       {"times", times},
                       {"run", flight->run().string()},
                       {"note", flight->note()}});
}

WebResponse Station::flightFrame(const WebRequest& request) {
  const auto k = numberOf(request.parameter("k"));
  if (!k) return plain(400, "k: must be the number of a frame");
  const auto flight = archive_.open(request.parameter("name"), false);
  if (!flight) return plain(404, "no such flight");
  if (*k >= static_cast<int64_t>(flight->frames()))
    return plain(404, "the flight has " + std::to_string(flight->frames()) + " frames");
  return bytesResponse(bundleOf(flight->view(static_cast<size_t>(*k)), *k));
}

WebResponse Station::report(const WebRequest& request) {
  const auto entry = archive_.report(request.parameter("name"));
  if (!entry) return plain(404, "no such report");
  WebResponse response;
  response.type = "text/html; charset=utf-8";
  response.file = entry->files.front();
  response.file_bytes = static_cast<size_t>(entry->bytes);
  // Whatever lies in the folders: it gets no scripts, and not the page's rights.
  response.headers.emplace_back("Content-Security-Policy",
                                "sandbox; default-src 'none'; img-src data:; style-src 'unsafe-inline'");
  return response;
}

WebResponse Station::write(const WebRequest& request) {
  std::string action;
  std::string process;
  if (request.path == "/api/record") {
    const std::string on = request.parameter("on");
    if (on != "0" && on != "1") return plain(400, "on: must be 0 or 1");
    action = on == "1" ? "start" : "stop";
    process = kRecord.name;
  } else if (request.path == "/api/restart") {
    action = "restart";
    process = request.parameter("process");
    if (!isKnownProcess("redbee-" + process)) return plain(404, "no such process");
  } else {
    return plain(404, "no such address");
  }
  const std::string fault = control_.act(action, process);
  return fault.empty() ? jsonResponse({{"done", action}}) : plain(409, fault);
}

}  // namespace redbee
