// An EuRoC folder with any tables: imported, or refused. Input: cam0's data.csv, imu0's, altimeter0's, cam0's
// sensor.yaml and imu0's, cut by lines of "%%". The one image there is is good.
#include <opencv2/imgcodecs.hpp>

#include "redbee/files/input_error.hpp"
#include "redbee/importers/import_asl.hpp"
#include "tests/fuzz/fuzz_input.hpp"

namespace redbee {
namespace {

void writeImage(const fuzz::Folder& folder) {
  const std::string name = "mav0/cam0/data/0.png";
  folder.write(name, "");
  cv::imwrite((folder / name).string(), cv::Mat(8, 8, CV_8U, cv::Scalar(90)));
}

}  // namespace
}  // namespace redbee

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace redbee;  // NOLINT: a target is one function
  static const fuzz::Folder folder;
  static const bool has_image = (writeImage(folder), true);
  const char* const names[] = {"mav0/cam0/data.csv", "mav0/imu0/data.csv", "mav0/altimeter0/data.csv",
                               "mav0/cam0/sensor.yaml", "mav0/imu0/sensor.yaml"};
  const auto contents = fuzz::parts(data, size, std::size(names));
  for (size_t i = 0; i < std::size(names); ++i) {
    std::filesystem::remove(folder / names[i]);
    if (!contents[i].empty()) folder.write(names[i], contents[i]);
  }
  if (!has_image) return 0;
  ImportOptions options;
  options.source = folder / "mav0";
  options.log = folder / "flight.lcm";
  Progress progress("", "", true);
  try {
    const ImportSummary summary = aslImporter().import(options, progress);
  } catch (const InputError&) {
  }
  return 0;
}
