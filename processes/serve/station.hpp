// The ground station: what each address of the page answers.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "processes/serve/access.hpp"
#include "processes/serve/archive.hpp"
#include "processes/serve/disk_gate.hpp"
#include "processes/serve/live.hpp"
#include "processes/serve/live_mosaic.hpp"
#include "processes/serve/web.hpp"

namespace redbee {

/// What the page may do to the stack; to be called by any thread.
struct StackControl {
  /// Whether the recorder runs; std::nullopt where no supervisor answers.
  std::function<std::optional<bool>()> is_recording;
  /// "start", "stop" or "restart", the name of a process. Returns the fault in words; empty: it was done.
  std::function<std::string(const std::string& action, const std::string& process)> act;
};

/// The control of the supervisor that started this process; where none did, one that says so.
StackControl supervisedStack();

/// To be used by any thread.
class Station {
 public:
  Station(Access access, Archive& archive, Live& live, StackControl control);

  /// Shows the map's tiles in a folder: z/x/y.png of the WebMercator tiling, as map servers call them.
  void showTiles(std::filesystem::path folder) { tiles_ = std::move(folder); }

  /// What grows while the stack flies; it must outlive the station.
  void showMosaic(LiveMosaic& mosaic) { mosaic_ = &mosaic; }

  /// Never throws.
  WebResponse answer(const WebRequest& request);
  /// By the headers alone, so that the body of who may not ask is not read; nor is one that is too long or of
  /// unknown length: no request of the page has a body.
  std::optional<WebResponse> refusal(const WebRequest& request) const;

 private:
  WebResponse route(const WebRequest& request);
  WebResponse liveFrame(const WebRequest& request) const;
  WebResponse liveMosaic(const WebRequest& request) const;
  WebResponse state() const;
  WebResponse fromDisk(const WebRequest& request);
  WebResponse flights(const WebRequest&);
  WebResponse flight(const WebRequest& request);
  WebResponse flightFrame(const WebRequest& request);
  WebResponse report(const WebRequest& request);
  WebResponse tileLevels(const WebRequest&);
  WebResponse tile(const WebRequest& request);
  WebResponse write(const WebRequest& request);

  Access access_;
  Archive& archive_;
  Live& live_;
  StackControl control_;
  DiskGate disk_;
  LiveMosaic* mosaic_ = nullptr;  ///< null: none
  std::filesystem::path tiles_;   ///< empty: none
};

/// The number in a text of digits alone; std::nullopt for any other.
std::optional<int64_t> numberOf(const std::string& text);

}  // namespace redbee
