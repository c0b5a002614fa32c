// Images of ROS messages as image_t.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>

#include "redbee/image_t.hpp"
#include "redbee/importers/image_file.hpp"
#include "redbee/importers/ros/ros_recording.hpp"

namespace redbee {

/// Its time is the stamp, or where that is 0 when it was logged. Grey stays raw, JPEG stays as it is, all
/// else becomes JPEG. Throws RosMessageError for a damaged message or an encoding that is not read,
/// InputError with `source` for a damaged JPEG or PNG.
LoadedImage convertRosImage(const RosMessage& message, const std::filesystem::path& source,
                            const ImageOptions& options);

/// The pixels of an image with 16 bits, std::nullopt for others. Throws as convertRosImage().
std::optional<cv::Mat> valuesOf16BitRosImage(const RosMessage& message, const std::filesystem::path& source);

}  // namespace redbee
