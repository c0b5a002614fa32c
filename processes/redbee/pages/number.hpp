// Numbers as text, for tables, pages and files.
#pragma once

#include <spdlog/fmt/fmt.h>

#include <string>

namespace redbee {

/// With so many digits behind the point.
inline std::string fixed(double value, int decimals) { return fmt::format("{:.{}f}", value, decimals); }

/// With so many digits in all, and an exponent where that is shorter. 17 digits read back to the last bit.
inline std::string significant(double value, int digits) { return fmt::format("{:.{}g}", value, digits); }

}  // namespace redbee
