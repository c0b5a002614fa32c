// Flights, runs and reports in the folders that the page shows.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
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
    /// Path from the folder's parent; where others are called the same, the whole path.
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
  std::optional<std::string> report(const std::string& name) const;

 private:
  struct Opened {
    std::string name;
    int64_t bytes = 0;  ///< a flight that is being recorded grows
    std::shared_ptr<const Flight> flight;
  };

  /// Files below the folders, newest first, each once; links are left out. Looked up every two seconds at
  /// most.
  std::vector<Entry> files() const;
  std::vector<Entry> readFolders() const;

  Configuration configuration_;
  std::vector<std::filesystem::path> folders_;
  mutable std::mutex files_mutex_;
  mutable std::vector<Entry> files_;
  mutable std::chrono::steady_clock::time_point files_read_;
  std::mutex mutex_;
  std::list<Opened> opened_;  ///< the last one used first
};

}  // namespace redbee
