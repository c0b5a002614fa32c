#include "redbee/importers/vector_table.hpp"

#include <algorithm>

#include "redbee/files/input_error.hpp"
#include "redbee/files/printable.hpp"
#include "redbee/importers/time_check.hpp"

namespace redbee {

bool hasColumn(const std::vector<std::string>& header, const std::string& name) {
  return std::find(header.begin(), header.end(), name) != header.end();
}

size_t columnOf(const CsvReader& csv, const std::string& name) {
  const auto& header = csv.header();
  const auto found = std::find(header.begin(), header.end(), name);
  if (found != header.end()) return static_cast<size_t>(found - header.begin());
  csv.fail("header names no column '" + name + "' (found: " + firstTenOf(header, " ") + ")");
}

int64_t timeOf(const CsvReader& csv, size_t column) {
  constexpr int64_t kLatest_ns = 4'000'000'000'000'000'000;  // the year 2096; differences cannot overflow
  const int64_t time_ns = csv.integer(column);
  if (time_ns < -kLatest_ns || time_ns > kLatest_ns)
    csv.fail("'" + csv.fields().at(column) + "' is no time in ns");
  return time_ns;
}

std::vector<AxisSample> readVectors(CsvReader& csv, const VectorColumns& columns,
                                    std::vector<std::string>& warnings) {
  std::vector<AxisSample> rows;
  std::vector<int64_t> utimes;
  // A table without a header has these columns alone.
  const size_t width = csv.header().empty() ? 1 + std::max({columns.time, columns.x, columns.y, columns.z})
                                            : csv.header().size();
  while (csv.next(width)) {
    AxisSample sample;
    sample.time_ns = timeOf(csv, columns.time);
    sample.value = {csv.number(columns.x), csv.number(columns.y), csv.number(columns.z)};
    rows.push_back(sample);
    utimes.push_back(fromNanoseconds(sample.time_ns).count());
  }
  if (rows.empty()) throw InputError(csv.path(), "holds no samples");
  const TimeFindings times = checkTimes(utimes, TimeOrder::kAsTheyCome, csv.path().string());
  for (const std::string& line : times.lines) warnings.push_back(csv.path().string() + ": " + line);
  return thoseKept(rows, times.keep);
}

std::vector<ImuSample> joinAtGyroTimes(const std::vector<AxisSample>& gyro,
                                       const std::vector<AxisSample>& accel, int64_t origin_ns) {
  std::vector<ImuSample> samples;
  size_t next = 0;  // the first of the accelerometer that is not before
  for (const AxisSample& rate : gyro) {
    while (next < accel.size() && accel[next].time_ns < rate.time_ns) ++next;
    if (next == accel.size()) break;
    const bool is_exact = accel[next].time_ns == rate.time_ns;
    if (next == 0 && !is_exact) continue;
    ImuSample sample;
    sample.time = ImuTime(fromNanoseconds(rate.time_ns) - fromNanoseconds(origin_ns));
    sample.gyro = rate.value;
    sample.accel = accel[next].value;
    if (!is_exact) {
      const AxisSample &before = accel[next - 1], &after = accel[next];
      const auto whole = static_cast<double>(after.time_ns) - static_cast<double>(before.time_ns);
      const double part = (static_cast<double>(rate.time_ns) - static_cast<double>(before.time_ns)) / whole;
      sample.accel = (1 - part) * before.value + part * after.value;
    }
    if (samples.empty() || sample.time > samples.back().time) samples.push_back(sample);
  }
  return samples;
}

int64_t firstInteger(const std::filesystem::path& file) {
  CsvReader csv(file);
  csv.skipHeader();
  if (!csv.next(0)) throw InputError(file, "is empty");
  return timeOf(csv, 0);
}

}  // namespace redbee
