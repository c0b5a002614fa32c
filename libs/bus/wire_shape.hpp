// Encoded layout of each message type: the lengths inside a message are compared with its size before
// anything is allocated for them. (Decoders made by lcm-gen resize first and check afterwards.)
#pragma once

#include <cstdint>
#include <string_view>

#include "redbee/detections_t.hpp"
#include "redbee/filter_snapshot_t.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/image_metadata_t.hpp"
#include "redbee/image_t.hpp"
#include "redbee/process_health_t.hpp"
#include "redbee/visual_homography_t.hpp"

namespace redbee {

/// Wire layout of a type after its hash:
///   `12`      that many bytes;
///   `s`       a string: int32 length with the closing NUL, which is the only one;
///   `#*5`     int32 count, then so many elements of 5 bytes each (arrays that share a count are added up:
///   the order does not matter);
///   `#(...)`  int32 count, then so many groups.
/// A layout that is empty belongs to a type of fixed size. A type with a member of variable size needs a
/// specialisation here; the messaging tests fail without one.
template <typename Message>
struct WireShape {
  static constexpr std::string_view kLayout = "";
  static bool countsAgree(const Message&) { return true; }
};

/// True when `data` (what follows the hash) is laid out so, to the byte. Allocates nothing, reads nothing
/// beyond `size`.
bool matchesLayout(std::string_view layout, const uint8_t* data, int64_t size);

template <typename Count, typename... Arrays>
bool countFits(Count count, const Arrays&... arrays) {
  return count >= 0 && ((static_cast<size_t>(count) == arrays.size()) && ...);
}

template <>
struct WireShape<image_metadata_t> {
  static constexpr std::string_view kLayout = "s #*1";
  static bool countsAgree(const image_metadata_t& m) { return countFits(m.n, m.value); }
};

template <>
struct WireShape<image_t> {
  static constexpr std::string_view kLayout = "24 #*1 #(s #*1)";
  static bool countsAgree(const image_t& m) {
    for (const auto& entry : m.metadata) {
      if (!WireShape<image_metadata_t>::countsAgree(entry)) return false;
    }
    return countFits(m.size, m.data) && countFits(m.nmetadata, m.metadata);
  }
};

template <>
struct WireShape<detections_t> {
  static constexpr std::string_view kLayout = "13 #*37";
  static bool countsAgree(const detections_t& m) { return countFits(m.n, m.detections); }
};

template <>
struct WireShape<foreground_t> {
  static constexpr std::string_view kLayout = "29 #*1 #*1 #*1";
  static bool countsAgree(const foreground_t& m) {
    return countFits(m.probability_size, m.probability) && countFits(m.mask_size, m.mask) &&
           countFits(m.unknown_size, m.unknown);
  }
};

template <>
struct WireShape<visual_homography_t> {
  static constexpr std::string_view kLayout = "633 #*17";
  static bool countsAgree(const visual_homography_t& m) {
    return countFits(m.n, m.x_previous, m.y_previous, m.x, m.y, m.inlier);
  }
};

template <>
struct WireShape<fused_homography_t> {
  static constexpr std::string_view kLayout = "2585 #*16";
  static bool countsAgree(const fused_homography_t& m) {
    return countFits(m.n, m.x_previous, m.y_previous, m.x, m.y);
  }
};

template <>
struct WireShape<filter_snapshot_t> {
  static constexpr std::string_view kLayout = "8 s 304";
  static bool countsAgree(const filter_snapshot_t&) { return true; }
};

template <>
struct WireShape<process_health_t> {
  static constexpr std::string_view kLayout = "8 s 9 s 112 s s s";
  static bool countsAgree(const process_health_t&) { return true; }
};

}  // namespace redbee
