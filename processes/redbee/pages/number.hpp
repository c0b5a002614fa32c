// Numbers as text, for tables, pages and files.
#pragma once

#include <spdlog/fmt/fmt.h>

#include <string>

namespace redbee {

inline constexpr double kMegabyte = 1 << 20;  ///< bytes

/// With this many decimals.
inline std::string fixed(double value, int decimals) { return fmt::format("{:.{}f}", value, decimals); }

/// With this many significant digits, and an exponent if that is shorter. 17 digits read back exactly.
inline std::string significant(double value, int digits) { return fmt::format("{:.{}g}", value, digits); }

}  // namespace redbee
