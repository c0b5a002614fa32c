// What our HTML pages share. They stand alone: style and images are inside of them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace redbee {

/// Text with the characters that HTML gives a meaning replaced.
std::string escapeHtml(std::string_view text);

/// A JPEG as an <img> element.
std::string jpegElement(std::string_view jpeg, const std::string& description);

}  // namespace redbee
