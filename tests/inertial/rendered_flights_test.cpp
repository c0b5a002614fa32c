// The filter on the rendered flights, whose IMU has bias, noise and airframe vibration: exact homographies
// with pixel noise are fed back, and the filter's are compared with the exact ones.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

#include "redbee/inertial/inertial_filter.hpp"
#include "tests/support/consumer_imu.hpp"
#include "tests/support/noisy_homography.hpp"
#include "tests/support/shared_flight.hpp"

namespace redbee::test {
namespace {

/// Rows of numbers; the first column is a time in ns and comes back in whole microseconds.
struct Row {
  Duration time;  ///< since the clocks began
  std::vector<double> values;
};
std::vector<Row> readTable(const fs::path& path) {
  std::ifstream file(path);
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    std::string cell;
    std::getline(cells, cell, ',');
    Row row{fromNanoseconds(std::stoll(cell)), {}};
    while (std::getline(cells, cell, ',')) row.values.push_back(std::stod(cell));
    rows.push_back(row);
  }
  return rows;
}

/// Numbers after `key`, wherever they stand in the file; `count` of them.
std::vector<double> numbersAfter(const fs::path& path, const std::string& key, std::size_t count) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  std::string all = text.str();
  all.erase(0, all.find(key) + key.size());
  for (char& c : all) {
    if (c == '[' || c == ']' || c == ',') c = ' ';
  }
  std::istringstream stream(all);
  std::vector<double> numbers;
  for (double x = 0; numbers.size() < count && stream >> x;) numbers.push_back(x);
  return numbers;
}

InertialParameters trueParameters(const fs::path& clip) {
  const std::vector<double> T = numbersAfter(clip / "groundtruth.yaml", "data:", 16);
  InertialParameters parameters;
  Eigen::Matrix3d R_IC;
  R_IC << T[0], T[1], T[2], T[4], T[5], T[6], T[8], T[9], T[10];
  parameters.extrinsics.R_CI = R_IC.transpose();
  parameters.extrinsics.p_IC = {T[3], T[7], T[11]};
  parameters.extrinsics.timeshift_s = numbersAfter(clip / "groundtruth.yaml", "time_offset_s:", 1)[0];
  parameters.noise = consumerNoise();
  return parameters;
}

class SharedFlight : public testing::TestWithParam<const char*> {};

TEST_P(SharedFlight, HomographyFedBackStaysBelowThreeTenthsOfAPixel) {
  const auto folder = sharedFlight(std::string("rendered/") + GetParam());
  if (!folder) GTEST_SKIP() << "the flight rendered/" << GetParam() << " is not there";
  const fs::path& clip = *folder;

  InertialParameters parameters = trueParameters(clip);
  const std::vector<Row> heights = readTable(clip / "mav0/altimeter0/data.csv");
  parameters.extrinsics.start_height_m = heights.front().values[0];
  InertialFilter filter(camera(), parameters);
  for (const Row& row : readTable(clip / "mav0/imu0/data.csv")) {
    const std::vector<double>& x = row.values;
    filter.addImu({ImuTime(row.time), {x[0], x[1], x[2]}, {x[3], x[4], x[5]}});
  }
  for (const Row& row : heights) filter.addAltitude({ImuTime(row.time), row.values[0], 0.05});

  std::mt19937 random(1);
  constexpr int kSettled = 24;  // frames: a second in which velocity becomes known
  double sum = 0;
  double normalised = 0;
  int count = 0;
  int refused = 0;
  int frame = 0;
  for (const Row& row : readTable(clip / "labels/homography.csv")) {
    const InertialHomography result = filter.advanceTo(CameraTime(row.time));
    if (frame++ == 0) continue;
    ASSERT_TRUE(result.valid) << frame;
    Eigen::Matrix3d exact;
    exact << row.values[1], row.values[2], row.values[3], row.values[4], row.values[5], row.values[6],
        row.values[7], row.values[8], row.values[9];
    if (frame > kSettled) {
      sum += meanTransferError(result.H, exact, kWidth, kHeight);
      normalised += normalisedErrorSquared(result.H, result.covariance, exact);
      ++count;
    }
    HomographyObservation observation = noisyHomography(exact, 0.3, random);
    observation.time_previous = result.time_previous;
    observation.time = result.time;
    refused += !filter.correct(observation).applied;
  }
  std::cout << GetParam() << ": mean transfer error " << sum / count << " px, normalised error squared "
            << normalised / count << " (8 expected), " << refused << " corrections refused\n";
  RecordProperty("transfer_error_px", std::to_string(sum / count));
  EXPECT_LT(sum / count, 0.3);
}

INSTANTIATE_TEST_SUITE_P(Clips, SharedFlight,
                         testing::Values("park1", "park2", "campus1", "grove1", "grove2"),
                         [](const auto& clip) { return std::string(clip.param); });

}  // namespace
}  // namespace redbee::test
