// The tables of an MP4 or MOV file, looked at before ffmpeg builds an index of them.
#pragma once

#include <filesystem>

namespace redbee {

/// ffmpeg allots memory for as many samples as a file states, gigabytes for a damaged one of a few hundred
/// bytes. Throws InputError where there are more than the file can hold; other containers have no such
/// tables.
void requirePossibleTables(const std::filesystem::path& file);

}  // namespace redbee
