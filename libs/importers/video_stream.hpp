// Which stream of a container is the recording, and how its images are turned.
#pragma once

#include <filesystem>

struct AVFormatContext;
struct AVStream;

namespace redbee {

/// The best stream that can be decoded and is no cover image or thumbnail; nullptr where there is none. The
/// others are discarded.
AVStream* findVideo(AVFormatContext& input);

struct VideoChoice {
  int number = 0;  ///< of the one that is taken, from 1
  int of = 0;
};
/// Among the videos in a file that are no cover image or thumbnail: a camera with two lenses writes two.
VideoChoice choiceOf(const AVFormatContext& input, const AVStream& taken);

/// Degrees clockwise, quarter turns. Throws InputError for another rotation or a mirror.
int rotationOf(const std::filesystem::path& path, const AVStream& stream);

/// Width over height of the stored images' pixels; 1 where the video states none, or one that no camera has.
double pixelAspectOf(const AVStream& stream);

}  // namespace redbee
