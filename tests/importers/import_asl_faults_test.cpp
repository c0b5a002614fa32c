// Faults of an ASL folder are reported with file and line, and leave no log behind.
#include "tests/support/asl_folder.hpp"

namespace redbee::test {
namespace {

class ImportAslFaults : public AslFolder {};

TEST_F(ImportAslFaults, BadInputIsReportedWithFileAndLine) {
  const fs::path list = mav() / "cam0" / "data.csv";
  const fs::path imu = mav() / "imu0" / "data.csv";
  struct Case {
    const char* what;
    std::function<void()> damage;
    std::string file_and_line;
    const char* fault;
  };
  const auto copyOf = [](const fs::path& file) { return readText(file); };
  const std::string good_list = copyOf(list);
  const std::string good_imu = copyOf(imu);
  const std::string good_image = copyOf(images_[3]);
  const std::string good_sensor = copyOf(mav() / "cam0" / "sensor.yaml");
  const std::vector<Case> cases = {
      {"no list", [&] { fs::remove(list); }, "cam0/data.csv: ", "no such file"},
      {"no images listed", [&] { writeText(list, "#timestamp,filename\n"); },
       "cam0/data.csv: ", "lists no images"},
      {"an image is missing", [&] { fs::remove(images_[3]); }, "cam0/data.csv:5: ", "is missing"},
      {"truncated JPEG", [&] { fs::resize_file(images_[3], good_image.size() / 2); }, images_[3].string(),
       "cut short"},
      {"JPEG header only", [&] { fs::resize_file(images_[3], 20); }, images_[3].string(), "header"},
      {"no image at all", [&] { writeText(images_[3], "hello"); }, images_[3].string(),
       "neither JPEG nor PNG"},
      {"empty image", [&] { writeText(images_[3], ""); }, images_[3].string(), "is an empty file"},
      {"mixed resolutions", [&] { cv::imwrite(images_[3].string(), texture(32, 48, 0, 3)); },
       images_[3].string(), "32x48"},
      {"frames run backwards", [&] { replaceLine(list, 4, std::to_string(kAslStart) + ",a.jpg"); },
       "cam0/data.csv:4: ", "backwards"},
      {"frames repeat", [&] { replaceLine(list, 4, lineOf(list, 3)); }, "cam0/data.csv:4: ", "repeats"},
      {"frame without name", [&] { replaceLine(list, 4, "17"); },
       "cam0/data.csv:4: ", "1 columns instead of 2"},
      {"frame time is no number", [&] { replaceLine(list, 4, "1e9,a.jpg"); },
       "cam0/data.csv:4: ", "no whole number"},
      {"IMU times rounded by a spreadsheet",
       [&] { replaceLine(imu, 9, "1.59999999998500E+018,0,0,0,0,0,9"); },
       "imu0/data.csv:9: '1.59999999998500E+018'", "a spreadsheet has rounded it"},
      {"IMU NaN", [&] { replaceLine(imu, 9, std::to_string(kAslStart - 15'000'000) + ",nan,0,0,0,0,9"); },
       "imu0/data.csv:9: ", "not finite"},
      {"IMU infinity",
       [&] { replaceLine(imu, 9, std::to_string(kAslStart - 15'000'000) + ",0,0,0,0,0,-inf"); },
       "imu0/data.csv:9: ", "not finite"},
      {"IMU columns", [&] { replaceLine(imu, 9, "1,2,3"); }, "imu0/data.csv:9: ", "3 columns instead of 7"},
      {"IMU backwards", [&] { replaceLine(imu, 9, lineOf(imu, 4)); }, "imu0/data.csv:9: ", "backwards"},
      {"IMU repeats", [&] { replaceLine(imu, 9, lineOf(imu, 8)); }, "imu0/data.csv:9: ", "repeats"},
      {"IMU empty", [&] { writeText(imu, "#t\n"); }, "imu0/data.csv: ", "holds no samples"},
      {"IMU list missing", [&] { fs::remove(imu); }, "imu0/data.csv: ", "no such file"},
      {"no rotation",
       [&] {
         replaceLine(mav() / "cam0" / "sensor.yaml", 5, "  data: [0,0,1,0, 1,0,0,0, 0,1,1,0, 0,0,0,1]");
       },
       "cam0/sensor.yaml:3: ", "T_BS"},
      {"other distortion model",
       [&] { replaceLine(mav() / "cam0" / "sensor.yaml", 9, "distortion_model: omni"); },
       "cam0/sensor.yaml:9: ", "'omni'"},
      {"calibration of another size",
       [&] { replaceLine(mav() / "cam0" / "sensor.yaml", 6, "resolution: [640, 480]"); },
       "cam0/sensor.yaml: ", "640x480"},
      {"broken yaml", [&] { replaceLine(mav() / "cam0" / "sensor.yaml", 6, "resolution: [64, 48"); },
       "cam0/sensor.yaml:", ""},
  };
  for (const Case& bad : cases) {
    bad.damage();
    const std::string line = errorMessage();
    EXPECT_NE(line.find(bad.file_and_line), std::string::npos) << bad.what << ": " << line;
    EXPECT_NE(line.find(bad.fault), std::string::npos) << bad.what << ": " << line;
    writeText(list, good_list);
    writeText(imu, good_imu);
    writeText(images_[3], good_image);
    writeText(mav() / "cam0" / "sensor.yaml", good_sensor);
  }
  EXPECT_EQ(import().frames, 5) << "the damage was not repaired between the cases";
}

TEST_F(ImportAslFaults, AnEmptyFolderIsRefused) {
  ImportOptions options;
  options.source = folder_ / "empty";
  options.log = log();
  fs::create_directories(options.source);
  Progress progress("importing", "frames", true);
  EXPECT_NE(
      errorMessageOf([&] { aslImporter().import(options, progress); }).find("holds neither mav0 nor cam0"),
      std::string::npos);
  options.source = folder_ / "none";
  EXPECT_NE(errorMessageOf([&] { aslImporter().import(options, progress); }).find("no such folder"),
            std::string::npos);
}

}  // namespace
}  // namespace redbee::test
