// Text for HTML.
#pragma once

#include <string>
#include <string_view>

namespace redbee {

/// Replaces the characters that HTML gives a meaning.
std::string escapeHtml(std::string_view text);
std::string base64(std::string_view data);

}  // namespace redbee
