// Identities that are not given twice, not even by the process that takes a dead one's place.
#pragma once

#include <filesystem>

namespace redbee {

/// The tracker counts its objects from 1. What is told of them goes on from the highest number that was told
/// before, which a file keeps: where nothing kept it, from 1.
class TrackIdStore {
 public:
  /// Keeps nothing.
  TrackIdStore() = default;
  /// Goes on from what the file says. A file that cannot be read or holds no number counts as none, and is
  /// said in the log.
  explicit TrackIdStore(std::filesystem::path file);

  /// The number to tell. A file that cannot be written is said in the log, once: the flight goes on.
  int globalId(int id);

 private:
  void keep();

  std::filesystem::path file_;
  int before_ = 0;   ///< told by those that came before
  int highest_ = 0;  ///< told by anyone
};

}  // namespace redbee
