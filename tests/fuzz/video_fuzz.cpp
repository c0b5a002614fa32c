// Any bytes as a video: its first frames and its motion track are read, or it is refused.
#include "redbee/files/input_error.hpp"
#include "redbee/importers/data_track.hpp"
#include "redbee/importers/video_reader.hpp"
#include "tests/fuzz/fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace redbee;  // NOLINT: a target is one function
  constexpr int kFrames = 8;
  static const fuzz::Folder folder;
  const auto file = folder.write("video.mp4", std::string(reinterpret_cast<const char*>(data), size));
  try {
    VideoReader reader(file, {});
    reader.expectedFrames();
    for (int i = 0; i < kFrames && reader.next(); ++i) {
    }
  } catch (const InputError&) {
  }
  try {
    readDataTrack(file, "gpmd");
  } catch (const InputError&) {
  }
  return 0;
}
