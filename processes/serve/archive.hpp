// Flights, runs and reports in the folders that the page shows.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <future>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "processes/serve/flight.hpp"

namespace redbee {

/// To be used by any thread. Names come from the browser: they are compared with what the folders hold, and
/// never become part of a path.
class Archive {
 public:
  struct Entry {
    /// Path from the folder's parent; where others are called the same, the whole path. Bytes that are no
    /// UTF-8, which no browser gives back, as their codes.
    std::string name;
    int64_t bytes = 0;
    int64_t modified_s = 0;                    ///< since 1970
    std::vector<std::filesystem::path> files;  ///< canonical; a log's parts in the order of their numbers
  };

  Archive(const Configuration& configuration, std::vector<std::filesystem::path> folders);

  /// Logs, the parts of a split one together; newest first.
  std::vector<Entry> flights() const;
  /// report.html and the like, newest first.
  std::vector<Entry> reports() const;

  /// Null if there is no flight of that name. Kept, as are a few others; read again where it has grown and
  /// `refresh` is set. Throws InputError as Flight does.
  std::shared_ptr<const Flight> open(const std::string& name, bool refresh);
  /// std::nullopt if there is no report of that name.
  std::optional<Entry> report(const std::string& name) const;

 private:
  using Clock = std::chrono::steady_clock;
  using Reading = std::shared_ptr<std::shared_future<std::shared_ptr<const Flight>>>;
  struct Opened {
    std::string name;
    int64_t bytes = 0;  ///< a flight that is being recorded grows
    Reading flight;
  };

  /// Of a flight that is being read, or was: who wants it waits, others do not.
  Reading readingOf(const Entry& entry);
  void forget(const Reading& reading);

  /// Files below the folders, newest first, each once; links are left out. Looked up every two seconds at
  /// most.
  std::vector<Entry> files() const;
  /// std::nullopt: looked up before that, or never.
  std::optional<std::vector<Entry>> filesSince(Clock::time_point oldest) const;
  std::vector<Entry> readFolders() const;

  Configuration configuration_;
  std::vector<std::filesystem::path> folders_;
  mutable std::mutex reading_mutex_;  ///< of who looks them up
  mutable std::mutex files_mutex_;
  mutable std::vector<Entry> files_;
  mutable Clock::time_point files_read_;
  std::mutex mutex_;
  std::list<Opened> opened_;  ///< the last one used first
};

}  // namespace redbee
