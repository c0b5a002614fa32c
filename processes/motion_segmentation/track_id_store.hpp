// Track identities that stay unique across restarts of the process.
#pragma once

#include <filesystem>

namespace redbee {

/// The tracker numbers its objects from 1. Published identities continue from the highest one published
/// before, which is stored in a file; without a file they start at 1.
class TrackIdStore {
 public:
  /// Not persistent.
  TrackIdStore() = default;
  /// Continues from the number in the file. If it cannot be read or is not a number, a warning is logged and
  /// identities start at 1.
  explicit TrackIdStore(std::filesystem::path file);

  /// The identity to publish for a tracker's `id`. If the file cannot be written, a warning is logged once.
  int globalId(int id);

 private:
  void save();

  std::filesystem::path file_;
  int offset_ = 0;   ///< highest identity published by earlier processes
  int highest_ = 0;  ///< highest identity published
};

}  // namespace redbee
