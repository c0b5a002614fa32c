// GoPro's metadata format (GPMF): nested key-length-value records, big-endian. See
// github.com/gopro/gpmf-parser.
//
// A record is four letters, a type character, a sample's size, a 16-bit count, and the samples padded to four
// bytes; type 0 holds records.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace redbee {

/// what() names the byte offset inside the payload.
class GpmfError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One record; points into the payload it was read from.
struct GpmfRecord {
  std::string key;
  char type = 0;
  size_t sample_size = 0;  ///< bytes
  size_t count = 0;
  size_t offset = 0;  ///< bytes, of `data` in the payload
  const uint8_t* data = nullptr;

  size_t size() const { return sample_size * count; }
  bool isContainer() const { return type == 0; }
};

/// The records of one level, `size` bytes at `data`. Throws GpmfError if a record exceeds them.
std::vector<GpmfRecord> gpmfRecords(const uint8_t* data, size_t size, size_t offset = 0);

/// One payload's samples of a three-axis sensor.
struct GpmfSamples {
  std::string name;                           ///< STNM, the camera's description of the axes
  std::string unit;                           ///< SIUN or UNIT
  std::vector<std::array<double, 3>> values;  ///< SCAL applied; axes in the order `axes`
  std::string axes =
      "ZXY";  ///< ORIO, after ORIN or MTRX has been applied; ZXY where the camera does not state it
  std::optional<int64_t> total_after;  ///< TSMP: samples since the recording began, this payload's included
  std::optional<double> stamp_s;       ///< STMP: time of the first sample on the recorder's own clock
};

/// All streams of this key ("GYRO", "ACCL") in a payload; containers nest at most `kMaxGpmfDepth` deep.
constexpr int kMaxGpmfDepth = 8;
std::vector<GpmfSamples> gpmfSensor(const std::vector<uint8_t>& payload, const std::string& key);

/// All samples of a stream of quaternions ("IORI", "CORI"), as stored: w first, SCAL applied. Throws
/// GpmfError.
std::vector<std::array<double, 4>> gpmfQuaternions(const std::vector<uint8_t>& payload,
                                                   const std::string& key);

}  // namespace redbee
