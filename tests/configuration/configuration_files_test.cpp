// The vehicle files of config/.
#include <fstream>
#include <set>

#include "tests/support/configuration_file.hpp"

namespace redbee::test {
namespace {

/// Keys that a file states itself, read without the loader: by the indentation of its lines.
std::set<std::string> keysStatedIn(const fs::path& file) {
  std::set<std::string> keys;
  std::vector<std::string> open;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const size_t indent = line.find_first_not_of(' ');
    const size_t colon = line.find(':');
    if (indent == std::string::npos || line[indent] == '#' || colon == std::string::npos) continue;
    if (line.find('#') < colon) continue;
    open.resize(indent / 2);
    open.push_back(line.substr(indent, colon - indent));
    const size_t value = line.find_first_not_of(' ', colon + 1);
    if (value == std::string::npos || line[value] == '#') continue;
    std::string key;
    for (const auto& part : open) key += (key.empty() ? "" : ".") + part;
    keys.insert(key);
  }
  return keys;
}

TEST(ReferenceFile, StatesEveryKeyAndNoOther) {
  const auto known = configurationKeys();
  EXPECT_EQ(keysStatedIn(kConfigFolder / "redbee.yaml"), std::set<std::string>(known.begin(), known.end()));
}

/// A line of emitted YAML that differs is a tunable whose value in the reference file is not the code's.
TEST(ReferenceFile, TunablesHaveTheDefaultsOfTheCode) {
  Configuration expected;
  const auto reference = loadConfiguration(kConfigFolder / "redbee.yaml");
  // What describes the vehicle is no tunable.
  expected.vehicle = reference.vehicle;
  expected.camera = reference.camera;
  expected.inertial.extrinsics.R_CI = reference.inertial.extrinsics.R_CI;
  expected.inertial.noise = reference.inertial.noise;
  EXPECT_EQ(emitYaml(reference), emitYaml(expected));
}

TEST(ConfigurationFiles, AllOfThemLoad) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(kConfigFolder)) {
    if (entry.path().extension() != ".yaml") continue;
    EXPECT_NO_THROW(loadConfiguration(entry.path())) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 4);
}

TEST(ConfigurationFiles, ExtrinsicsOfEurocAreThePublishedOnes) {
  const auto euroc = loadConfiguration(kConfigFolder / "euroc_mav.yaml");
  // The camera's optical axis in body coordinates is the third column of the published T_BS.
  const Eigen::Vector3d axis = euroc.inertial.extrinsics.R_CI.transpose() * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(axis.x(), 0.00414029679422, 1e-12);
  EXPECT_NEAR(axis.y(), 0.025715529948, 1e-12);
}

}  // namespace
}  // namespace redbee::test
