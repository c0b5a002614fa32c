#include "processes/redbee/calibrate/calibration_target_csv.hpp"

#include <zlib.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>

#include "redbee/files/csv.hpp"
#include "redbee/files/input_error.hpp"

namespace redbee {
namespace {

/// A temporary file, deleted with the object.
class TemporaryFile {
 public:
  TemporaryFile() {
    std::string name = (std::filesystem::temp_directory_path() / "redbee-XXXXXX").string();
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0) throw InputError(name, "cannot be created");
    path_ = name;
    file_ = fdopen(descriptor, "wb");
  }
  ~TemporaryFile() {
    if (file_ != nullptr) std::fclose(file_);
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(const char* data, size_t size) {
    if (std::fwrite(data, 1, size, file_) != size) throw InputError(path_, "cannot be written");
  }
  const std::filesystem::path& close() {
    const int failed = std::fclose(file_);
    file_ = nullptr;
    if (failed != 0) throw InputError(path_, "cannot be written");
    return path_;
  }

 private:
  std::filesystem::path path_;
  std::FILE* file_ = nullptr;
};

/// Reads plain files too: gzread copies what is not compressed.
void unpack(const std::filesystem::path& archive, TemporaryFile& plain) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(archive.c_str(), "rb"), gzclose);
  if (!file) throw InputError(archive, "cannot be read");
  std::array<char, 1 << 16> buffer;
  int count = 0;
  while ((count = gzread(file.get(), buffer.data(), buffer.size())) > 0) {
    plain.write(buffer.data(), static_cast<size_t>(count));
  }
  if (count < 0 || !gzeof(file.get())) throw InputError(archive, "is damaged or cut short");
}

std::vector<calibration::TargetView> cornersIn(CsvReader& csv) {
  constexpr size_t kColumns = 12;
  std::vector<calibration::TargetView> views;
  while (csv.next(kColumns)) {
    const CameraTime time(fromNanoseconds(csv.integer(0)));
    if (views.empty() || views.back().time != time) {
      if (!views.empty() && time < views.back().time) csv.fail("time runs backwards");
      views.push_back({time, {}, {}});
    }
    views.back().pixels.emplace_back(csv.number(5), csv.number(6));
    views.back().corners.emplace_back(csv.number(7), csv.number(8), csv.number(9));
  }
  return views;
}

std::vector<calibration::TargetView> cornersInArchive(const std::filesystem::path& archive) {
  TemporaryFile plain;
  unpack(archive, plain);
  const std::filesystem::path unpacked = plain.close();
  try {
    CsvReader reader(unpacked);
    return cornersIn(reader);
  } catch (const InputError& error) {
    // The user knows the archive, not its unpacked copy.
    throw InputError(archive.string() + std::string(error.what()).substr(unpacked.string().size()));
  }
}

}  // namespace

std::vector<calibration::TargetView> readTargetCorners(const std::filesystem::path& csv) {
  std::vector<calibration::TargetView> views;
  if (csv.extension() == ".gz") {
    views = cornersInArchive(csv);
  } else {
    CsvReader reader(csv);
    views = cornersIn(reader);
  }
  if (views.empty()) throw InputError(csv, "holds no corners");
  return views;
}

std::vector<ImuSample> readTargetImu(const std::filesystem::path& csv) {
  constexpr size_t kColumns = 7;
  CsvReader reader(csv);
  IncreasingTimeCheck times;
  std::vector<ImuSample> samples;
  while (reader.next(kColumns)) {
    ImuSample sample;
    sample.time = ImuTime(fromNanoseconds(reader.integer(0)));
    times.check(reader, toUtime(sample.time));
    sample.gyro = {reader.number(1), reader.number(2), reader.number(3)};
    sample.accel = {reader.number(4), reader.number(5), reader.number(6)};
    samples.push_back(sample);
  }
  if (samples.empty()) throw InputError(csv, "holds no IMU samples");
  return samples;
}

}  // namespace redbee
