#include "processes/motion_segmentation/track_id_store.hpp"

#include <spdlog/spdlog.h>

#include <exception>
#include <fstream>
#include <utility>

#include "redbee/files/atomic_file.hpp"

namespace redbee {

TrackIdStore::TrackIdStore(std::filesystem::path file) : file_(std::move(file)) {
  std::ifstream stream(file_);
  if (!stream) return;
  if (!(stream >> offset_) || offset_ < 0) {
    spdlog::warn("{}: holds no identity: they start at 1", file_.string());
    offset_ = 0;
  }
  highest_ = offset_;
}

int TrackIdStore::globalId(int id) {
  const int number = offset_ + id;
  if (number > highest_) {
    highest_ = number;
    save();
  }
  return number;
}

void TrackIdStore::save() {
  if (file_.empty()) return;
  try {
    writeAtomically(file_, std::to_string(highest_) + "\n");
  } catch (const std::exception& error) {
    spdlog::warn("identities may be given twice after a restart: {}", error.what());
    file_.clear();
  }
}

}  // namespace redbee
