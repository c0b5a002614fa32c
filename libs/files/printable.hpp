// Text out of files, as a line of a terminal may show it.
#pragma once

#include <string>
#include <vector>

namespace redbee {

/// Control characters and bytes that are no UTF-8 as their hexadecimal codes: names in a recording must
/// neither start a second line nor command a terminal.
std::string printable(const std::string& text);

/// "a, b, c and 7 more": ten at most.
std::string firstTenOf(const std::vector<std::string>& names, const std::string& separator = ", ");

}  // namespace redbee
