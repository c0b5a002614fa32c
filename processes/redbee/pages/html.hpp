// Escaping and encoding for HTML.
#pragma once

#include <string>
#include <string_view>

namespace redbee {

/// Escapes the special characters of HTML.
std::string escapeHtml(std::string_view text);
std::string base64(std::string_view data);

}  // namespace redbee
