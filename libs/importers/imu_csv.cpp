#include "redbee/importers/imu_csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "redbee/files/csv.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/printable.hpp"
#include "redbee/importers/row_times.hpp"

namespace redbee {
namespace {

constexpr std::array<const char*, 7> kColumnNames = {"t_s", "gx", "gy", "gz", "ax", "ay", "az"};
using ColumnNumbers = std::array<size_t, kColumnNames.size()>;

ColumnNumbers findColumns(const CsvReader& csv, const std::vector<std::string>& header) {
  ColumnNumbers columns{};
  for (size_t i = 0; i < kColumnNames.size(); ++i) {
    const auto found = std::find(header.begin(), header.end(), kColumnNames[i]);
    if (found == header.end()) {
      if (header.size() == 1)
        csv.fail("has one column: commas, semicolons or tabs separate columns, not blanks");
      csv.fail(std::string("header names no column '") + kColumnNames[i] +
               "' (found: " + firstTenOf(header, " ") + "; needed: t_s gx gy gz ax ay az)");
    }
    columns[i] = static_cast<size_t>(found - header.begin());
  }
  return columns;
}

/// Leaves the reader before the first sample.
ColumnNumbers readHeader(CsvReader& csv) {
  csv.skipHeader();
  const std::vector<std::string>& header = csv.header();
  if (header.empty()) {
    if (!csv.next(0)) throw InputError(csv.path(), "is empty");
    return findColumns(csv, csv.fields());
  }
  return findColumns(csv, header);
}

}  // namespace

ImuTable readImuCsv(const std::filesystem::path& file, const ImuUnits& units) {
  constexpr double kLatest_s = 1e10;  // the year 2286; far beyond it microseconds overflow
  const double to_s = factorOf(timeUnits(), units.time, "--time-unit");
  const double to_rad_s = factorOf(gyroUnits(), units.gyro, "--gyro-unit");
  const double to_m_s2 = factorOf(accelUnits(), units.accel, "--accel-unit");
  CsvReader csv(file);
  const ColumnNumbers columns = readHeader(csv);
  const size_t width = csv.columns();
  RowTimes times;
  ImuTable table;
  table.units = units;
  while (csv.next(width)) {
    ImuSample sample;
    const double t_s = to_s * csv.number(columns[0]);
    if (std::abs(t_s) > kLatest_s) {
      csv.fail("'" + csv.fields().at(columns[0]) + "' " + units.time +
               " is no time: give its unit with --time-unit ms, us or ns");
    }
    sample.time = ImuTime(fromSeconds(t_s));
    times.add(csv, toUtime(sample.time));
    for (int axis = 0; axis < 3; ++axis) {
      sample.gyro[axis] = to_rad_s * csv.number(columns[static_cast<size_t>(1 + axis)]);
      sample.accel[axis] = to_m_s2 * csv.number(columns[static_cast<size_t>(4 + axis)]);
    }
    table.samples.push_back(sample);
  }
  if (table.samples.empty()) throw InputError(file, "holds no samples");
  times.check(table.samples, table.warnings);
  return table;
}

}  // namespace redbee
