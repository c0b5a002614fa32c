#include "redbee/importers/gpmf.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <functional>

namespace redbee {
namespace {

constexpr size_t kRecordHeader = 8;

uint64_t bigEndian(const uint8_t* from, size_t bytes) {
  uint64_t value = 0;
  for (size_t i = 0; i < bytes; ++i) value = value << 8 | from[i];
  return value;
}

std::string at(size_t offset) { return "GPMF byte " + std::to_string(offset) + ": "; }

size_t elementSize(char type) {
  switch (type) {
    case 'b':
    case 'B':
    case 'c':
      return 1;
    case 's':
    case 'S':
      return 2;
    case 'l':
    case 'L':
    case 'f':
      return 4;
    case 'd':
    case 'j':
    case 'J':
      return 8;
    default:
      return 0;
  }
}

double element(char type, const uint8_t* from) {
  const uint64_t bits = bigEndian(from, elementSize(type));
  switch (type) {
    case 'b':
      return static_cast<int8_t>(bits);
    case 's':
      return static_cast<int16_t>(bits);
    case 'l':
      return static_cast<int32_t>(bits);
    case 'j':
      return static_cast<double>(static_cast<int64_t>(bits));
    case 'f': {
      const auto word = static_cast<uint32_t>(bits);
      float value = 0;
      std::memcpy(&value, &word, sizeof value);
      return static_cast<double>(value);
    }
    case 'd': {
      double value = 0;
      std::memcpy(&value, &bits, sizeof value);
      return value;
    }
    default:
      return static_cast<double>(bits);
  }
}

/// All elements of a record, whatever their grouping into samples.
std::vector<double> elements(const GpmfRecord& record) {
  const size_t size = elementSize(record.type);
  if (size == 0 || record.sample_size % size != 0) {
    throw GpmfError(at(record.offset) + record.key + " has a type that holds no numbers");
  }
  std::vector<double> values(record.size() / size);
  for (size_t i = 0; i < values.size(); ++i) values[i] = element(record.type, record.data + i * size);
  return values;
}

std::string text(const GpmfRecord& record) {
  std::string out(record.data, record.data + record.size());
  while (!out.empty() && (out.back() == '\0' || out.back() == ' ')) out.pop_back();
  return out;
}

/// A stream's description of its samples, which precedes them.
struct StreamContext {
  GpmfSamples samples;
  std::vector<double> scale = {1};
  std::string orin;
  std::string orio;
  std::vector<double> matrix;
  std::string device;  ///< which has this stream
};

using Axes = std::array<std::array<double, 3>, 3>;

/// ORIN names the axes as stored, ORIO as they should be; a lower-case letter is the opposite direction. MTRX
/// is the same as a matrix.
Axes axisMapping(const StreamContext& context, size_t offset) {
  Axes mapping{};
  if (context.orin.size() == 3 && context.orio.size() == 3) {
    for (size_t out = 0; out < 3; ++out) {
      for (size_t in = 0; in < 3; ++in) {
        const auto to = static_cast<unsigned char>(context.orio[out]);
        const auto from = static_cast<unsigned char>(context.orin[in]);
        if (std::toupper(to) == std::toupper(from)) mapping[out][in] = to == from ? 1 : -1;
      }
    }
  } else if (context.matrix.size() == 9) {
    for (size_t i = 0; i < 9; ++i) mapping[i / 3][i % 3] = context.matrix[i];
  } else if (context.device == "Fusion") {
    mapping = {{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}};  // states none; by GoPro's documentation it is -Y, X, Z
  } else {
    mapping[0][0] = mapping[1][1] = mapping[2][2] = 1;
  }
  for (const auto& row : mapping) {
    const double norm = std::hypot(row[0], row[1], row[2]);
    if (!(std::abs(norm - 1) < 0.1)) throw GpmfError(at(offset) + "ORIN, ORIO or MTRX is no change of axes");
  }
  return mapping;
}

GpmfSamples scaled(const StreamContext& context, const GpmfRecord& record) {
  GpmfSamples out = context.samples;
  const std::vector<double> raw = elements(record);
  if (raw.size() != record.count * 3) throw GpmfError(at(record.offset) + record.key + " has not three axes");
  if (context.scale.size() != 1 && context.scale.size() != 3) {
    throw GpmfError(at(record.offset) + record.key + ": SCAL has neither one nor three numbers");
  }
  for (const double scale : context.scale) {
    if (!std::isfinite(scale) || scale == 0)
      throw GpmfError(at(record.offset) + record.key + ": SCAL is zero");
  }
  const Axes mapping = axisMapping(context, record.offset);
  if (context.orio.size() == 3) {
    out.axes.clear();
    for (const char axis : context.orio)
      out.axes += static_cast<char>(std::toupper(static_cast<unsigned char>(axis)));
  }
  out.values.resize(record.count);
  for (size_t i = 0; i < record.count; ++i) {
    for (size_t row = 0; row < 3; ++row) {
      double sum = 0;
      for (size_t column = 0; column < 3; ++column) {
        const double scale = context.scale[context.scale.size() == 3 ? column : 0];
        sum += mapping[row][column] * raw[3 * i + column] / scale;
      }
      out.values[i][row] = sum;
    }
  }
  return out;
}

void describe(StreamContext& context, const GpmfRecord& record) {
  const std::string& key = record.key;
  if (key == "DVNM") context.device = text(record);
  if (key == "STNM") context.samples.name = text(record);
  if (key == "SIUN" || key == "UNIT") {
    // One unit per axis may be listed; they are the same for all axes of these sensors.
    const size_t length = std::min(record.size(), std::max<size_t>(record.sample_size, 1));
    GpmfRecord first = record;
    first.sample_size = record.sample_size == 1 ? record.size() : length;
    first.count = record.size() == 0 ? 0 : 1;
    context.samples.unit = text(first);
  }
  if (key == "SCAL") context.scale = elements(record);
  if (key == "ORIN") context.orin = text(record);
  if (key == "ORIO") context.orio = text(record);
  if (key == "MTRX") context.matrix = elements(record);
  if (key == "TSMP" && record.size() >= 4)
    context.samples.total_after = static_cast<int64_t>(elements(record).at(0));
  if (key == "STMP" && record.size() >= 8) context.samples.stamp_s = 1e-6 * elements(record).at(0);
}

using TakeStream = std::function<void(const StreamContext&, const GpmfRecord&)>;

/// Calls `take` for each record of this key, with the description that precedes it.
void forEachStream(const std::vector<GpmfRecord>& records, const std::string& key, int depth,
                   const TakeStream& take, const std::string& device = "") {
  StreamContext context;
  context.device = device;
  for (const GpmfRecord& record : records) {
    if (record.isContainer()) {
      if (depth >= kMaxGpmfDepth) throw GpmfError(at(record.offset) + "containers are nested too deep");
      forEachStream(gpmfRecords(record.data, record.size(), record.offset), key, depth + 1, take,
                    context.device);
    } else if (record.key == key) {
      take(context, record);
    } else {
      describe(context, record);
    }
  }
}

}  // namespace

std::vector<GpmfRecord> gpmfRecords(const uint8_t* data, size_t size, size_t offset) {
  std::vector<GpmfRecord> records;
  size_t position = 0;
  while (size - position >= kRecordHeader) {
    const uint8_t* header = data + position;
    if (bigEndian(header, 4) == 0) break;  // padding at the end of a payload
    GpmfRecord record;
    record.key.assign(header, header + 4);
    record.type = static_cast<char>(header[4]);
    record.sample_size = header[5];
    record.count = bigEndian(header + 6, 2);
    record.offset = offset + position + kRecordHeader;
    record.data = header + kRecordHeader;
    if (record.size() > size - position - kRecordHeader) {
      throw GpmfError(at(offset + position) + record.key + " claims " + std::to_string(record.size()) +
                      " bytes where " + std::to_string(size - position - kRecordHeader) + " are left");
    }
    records.push_back(record);
    const size_t padded = (record.size() + 3) / 4 * 4;
    position += kRecordHeader + std::min(padded, size - position - kRecordHeader);
  }
  return records;
}

std::vector<GpmfSamples> gpmfSensor(const std::vector<uint8_t>& payload, const std::string& key) {
  std::vector<GpmfSamples> found;
  forEachStream(gpmfRecords(payload.data(), payload.size()), key, 0,
                [&](const StreamContext& context, const GpmfRecord& record) {
                  found.push_back(scaled(context, record));
                });
  return found;
}

std::vector<std::array<double, 4>> gpmfQuaternions(const std::vector<uint8_t>& payload,
                                                   const std::string& key) {
  std::vector<std::array<double, 4>> found;
  forEachStream(gpmfRecords(payload.data(), payload.size()), key, 0,
                [&](const StreamContext& context, const GpmfRecord& record) {
                  const std::vector<double> raw = elements(record);
                  const double scale = context.scale.empty() ? 0 : context.scale.front();
                  if (raw.size() != record.count * 4 || !std::isfinite(scale) || scale == 0)
                    throw GpmfError(at(record.offset) + key + " holds no quaternions");
                  for (size_t i = 0; i < record.count; ++i) {
                    const double* q = raw.data() + 4 * i;
                    found.push_back({q[0] / scale, q[1] / scale, q[2] / scale, q[3] / scale});
                  }
                });
  return found;
}

}  // namespace redbee
