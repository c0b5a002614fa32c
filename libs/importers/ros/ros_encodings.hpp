// sensor_msgs/image_encodings.h against the pixel formats of image_t.
#pragma once

#include <cstdint>
#include <string>

namespace redbee {

/// image_t's number of an encoding of 8 bits a channel; 0 for others.
int32_t pixelFormatOf(const std::string& ros_encoding);
/// Their names, for a message.
std::string rosEncodings();
/// The encoding of a pixel format, by its name as Foxglove has it; empty where there is none.
std::string rosEncodingOf(int32_t pixelformat);

}  // namespace redbee
