#include "redbee/importers/gcsv.hpp"

#include <Eigen/LU>
#include <cctype>
#include <cmath>
#include <fstream>
#include <string>

#include "redbee/files/csv.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"
#include "redbee/importers/gravity.hpp"
#include "redbee/importers/row_times.hpp"

namespace redbee {
namespace {

constexpr double kStandardGravityOfGcsv = 9.80665;  // m/s^2

struct GcsvHeader {
  double time_s = 1e-3;  ///< of one count
  double gyro = 1;       ///< rad/s
  double accel = 1;      ///< g
  Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();
  std::string orientation_text;
};

/// "YxZ": the first axis is Y, the second x turned round, the third Z.
///
/// A mirroring one is kept out: no gyro is mirrored, but loggers write "xyz" where nobody has set another.
Eigen::Matrix3d orientationOf(const std::string& text, const CsvReader& csv) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  if (text.size() != 3) csv.fail("orientation '" + text + "' has not three letters");
  for (int row = 0; row < 3; ++row) {
    const char letter = text[static_cast<size_t>(row)];
    const int axis = std::tolower(static_cast<unsigned char>(letter)) - 'x';
    if (axis < 0 || axis > 2) csv.fail("orientation '" + text + "' has another letter than x, y and z");
    matrix(row, axis) = std::isupper(static_cast<unsigned char>(letter)) != 0 ? 1 : -1;
  }
  if (matrix.determinant() == 0) csv.fail("orientation '" + text + "' repeats an axis");
  return matrix.determinant() > 0 ? matrix : Eigen::Matrix3d::Identity();
}

double positiveScale(const CsvReader& csv) {
  const double scale = csv.number(1);
  if (!(scale > 0)) csv.fail(csv.fields()[0] + ": must be above 0");
  return scale;
}

/// Leaves the reader before the first sample; its latest row is the names of the columns.
GcsvHeader readGcsvHeader(CsvReader& csv) {
  GcsvHeader header;
  while (csv.next(0)) {
    const auto& fields = csv.fields();
    if (fields[0] == "t" || fields[0] == "time") return header;
    if (fields.size() < 2) continue;  // the first line
    if (fields[0] == "tscale") header.time_s = positiveScale(csv);
    if (fields[0] == "gscale") header.gyro = positiveScale(csv);
    if (fields[0] == "ascale") header.accel = positiveScale(csv);
    if (fields[0] == "orientation") {
      header.orientation = orientationOf(fields[1], csv);
      header.orientation_text = fields[1];
    }
  }
  throw InputError(csv.path(), "has no line with the names of the columns (t,gx,gy,gz,ax,ay,az)");
}

/// Whether there is gravity in the values, in g or, as the format's own example has it, in m/s^2.
struct Unit {
  bool is_g = false;
  bool is_metric = false;
};

Unit unitOf(const std::vector<ImuSample>& samples) {
  const auto unitBy = [](double length) {
    return Unit{isGravity(kStandardGravityOfGcsv * length), isGravity(length)};
  };
  const double length = medianForce(samples);
  const Unit unit = unitBy(length);
  // The mean is right only with the gyro's unit; of a sensor that is shaken hard there is nothing better.
  if (unit.is_g || unit.is_metric) return unit;
  return unitBy(meanGravity(samples).value_or(length));
}

/// A camera is known (RunCam's Thumb, firmware 2.0.0) that writes the one's counts under the other's name.
void fixSwappedColumns(const std::filesystem::path& file, const GcsvHeader& header, ImuTable& table) {
  const Unit unit = unitOf(table.samples);
  if (unit.is_g || unit.is_metric) return;
  std::vector<ImuSample> swapped = table.samples;
  for (ImuSample& sample : swapped) {
    const Eigen::Vector3d gyro = sample.gyro;
    sample.gyro = header.gyro / header.accel * sample.accel;
    sample.accel = header.accel / header.gyro * gyro;
  }
  if (!unitOf(swapped).is_g) return;
  table.samples = swapped;
  table.warnings.push_back(file.string() + ": gravity stands in the gyro's columns: read as swapped");
}

/// The format's scale gives g.
void fixAccelUnit(const std::filesystem::path& file, ImuTable& table) {
  const Unit unit = unitOf(table.samples);
  const bool is_metric = unit.is_metric && !unit.is_g;
  for (ImuSample& sample : table.samples) {
    if (!is_metric) sample.accel *= kStandardGravityOfGcsv;
  }
  table.units.accel = is_metric ? "m/s2" : "g";
  if (is_metric) table.warnings.push_back(file.string() + ": ascale gives m/s^2, not g as the format has it");
}

/// What was done with the axes.
void noteOrientation(const std::filesystem::path& file, const GcsvHeader& header, ImuTable& table) {
  const std::string& text = header.orientation_text;
  if (text.empty() || text == "XYZ") return;
  const std::string what = header.orientation.isIdentity()
                               ? "its orientation " + text +
                                     " would mirror the axes, which no sensor does: they are left as they are"
                               : "axes are turned by its orientation " + text;
  table.warnings.push_back(file.string() + ": " + what + "; camera.R_CI must relate the camera to those");
}

}  // namespace

bool isGcsv(const std::filesystem::path& file) {
  if (!faultOfInput(file).empty()) return false;
  std::string line;
  std::ifstream in(file);
  std::getline(in, line);
  return line.rfind("GYROFLOW IMU LOG", 0) == 0 || line.rfind("CAMERA IMU LOG", 0) == 0;
}

ImuTable readGcsv(const std::filesystem::path& file, const ImuUnits& units) {
  constexpr double kLatest_s = 1e10;
  CsvReader csv(file);
  const GcsvHeader header = readGcsvHeader(csv);
  const std::vector<std::string> names = csv.fields();
  const bool has_both = names.size() >= 7 && (names[1] == "gx" || names[1] == "rx") && names[4] == "ax";
  if (!has_both)
    csv.fail(
        "names not the columns t,gx,gy,gz,ax,ay,az: without an accelerometer there is no gravity to fly by");
  ImuTable table;
  RowTimes times;
  while (csv.next(names.size())) {
    ImuSample sample;
    const double time_s = header.time_s * csv.number(0);
    if (!(std::abs(time_s) < kLatest_s)) csv.fail("'" + csv.fields()[0] + "' is no time");
    sample.time = ImuTime(fromSeconds(time_s));
    times.add(csv, toUtime(sample.time));
    sample.gyro =
        header.gyro * (header.orientation * Eigen::Vector3d(csv.number(1), csv.number(2), csv.number(3)));
    sample.accel =
        header.accel * (header.orientation * Eigen::Vector3d(csv.number(4), csv.number(5), csv.number(6)));
    table.samples.push_back(sample);
  }
  if (table.samples.empty()) throw InputError(file, "holds no samples");
  times.check(table.samples, table.warnings);
  // Its scale is in the file, but may be wrong.
  table.units.gyro = units.gyro;
  const double gyro_factor = factorOf(gyroUnits(), units.gyro, "--gyro-unit");
  for (ImuSample& sample : table.samples) sample.gyro *= gyro_factor;
  fixSwappedColumns(file, header, table);
  fixAccelUnit(file, table);
  noteOrientation(file, header, table);
  return table;
}

}  // namespace redbee
