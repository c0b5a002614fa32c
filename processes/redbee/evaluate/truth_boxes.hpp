// Ground-truth boxes of a clip, by frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>

#include "redbee/evaluation/object_measures.hpp"

namespace redbee {

/// By the number of the frame, from 0.
using TruthBoxes = std::multimap<int64_t, TruthObject>;

/// boxes.csv: frame_index, frame_file, object_id, class, state, x, y, w, h [px]. Throws InputError.
TruthBoxes readBoxes(const std::filesystem::path& file);
/// ignore.csv: frame_index, x, y, w, h [px]; empty if there is no such file. Throws InputError.
TruthBoxes readIgnoredBoxes(const std::filesystem::path& file);
/// MOT challenge's gt.txt: frame and pixels counted from 1: frame, id, x, y, w, h, counts, class, visibility.
/// People and vehicles that the file counts are objects; all else, such as static people, is not. Throws
/// InputError.
TruthBoxes readMotBoxes(const std::filesystem::path& file);
/// gt/gt.txt or gt.txt of a folder, if there is one.
std::optional<std::filesystem::path> motFileIn(const std::filesystem::path& folder);

}  // namespace redbee
