#include "redbee/importers/edit_list.hpp"

#include <string_view>

#include "redbee/files/ffmpeg.hpp"

namespace redbee {

EditList::EditList(const std::filesystem::path& file, const AVFormatContext& input, const AVStream& stream) {
  if (std::string_view(input.iformat->name).find("mp4") == std::string_view::npos) return;
  // Without the "advanced" edit lists the first edit alone moves the clock, and no frame is left out.
  const ffmpeg::Input whole =
      ffmpeg::openInput(file, {{"advanced_editlist", "0"}}, ffmpeg::Probe::kHeaderOnly);
  if (static_cast<unsigned>(stream.index) >= whole->nb_streams) return;
  AVStream* uncut = whole->streams[stream.index];
  std::unordered_map<int64_t, int64_t> true_times;
  for (int i = 0; i < avformat_index_get_entries_count(uncut); ++i) {
    const AVIndexEntry* entry = avformat_index_get_entry(uncut, i);
    true_times[entry->pos] = entry->timestamp;
  }
  auto* shown = const_cast<AVStream*>(&stream);  // ffmpeg's function reads, and takes no const
  for (int i = 0; i < avformat_index_get_entries_count(shown); ++i) {
    const AVIndexEntry* entry = avformat_index_get_entry(shown, i);
    // From a key frame before the cut, for the decoder; what is shown before an earlier cut may be among
    // them.
    if ((entry->flags & AVINDEX_DISCARD_FRAME) != 0) continue;
    const auto found = true_times.find(entry->pos);
    if (found != true_times.end() && found->second != entry->timestamp)
      shifts_[entry->pos] = found->second - entry->timestamp;
  }
}

int64_t EditList::shiftAt(int64_t position) const {
  const auto found = shifts_.find(position);
  return found == shifts_.end() ? 0 : found->second;
}

}  // namespace redbee
