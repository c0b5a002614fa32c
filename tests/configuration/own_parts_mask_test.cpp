// camera.mask: an image file beside the vehicle file.
#include <opencv2/imgcodecs.hpp>

#include "tests/support/configuration_file.hpp"

namespace redbee::test {
namespace {

using testing::HasSubstr;

const std::string kMasked =
    "camera: {width: 64, height: 48, fx: 50, fy: 50, cx: 31.5, cy: 23.5, mask: parts.png}\n";

class OwnPartsMask : public ConfigurationFile {
 protected:
  void writeMask(const cv::Mat& image) const { cv::imwrite((folder_ / "parts.png").string(), image); }
};

TEST_F(OwnPartsMask, IsReadFromBesideTheVehicleFile) {
  cv::Mat1b image(48, 64, uchar{90});
  image(cv::Rect(0, 0, 10, 5)).setTo(200);
  writeMask(image);
  const Configuration configuration = load(kMasked);
  EXPECT_EQ(configuration.mask, (folder_ / "parts.png").string());
  ASSERT_EQ(configuration.own_parts.size(), cv::Size(64, 48));
  EXPECT_EQ(cv::countNonZero(configuration.own_parts), 50);
  EXPECT_EQ(configuration.own_parts(4, 9), 255);
}

TEST_F(OwnPartsMask, IsFoundFromWhereverTheEmittedFileLies) {
  writeMask(cv::Mat1b(cv::Mat1b::eye(48, 64) * 255));
  const Configuration configuration = load(kMasked);
  fs::create_directory(folder_ / "elsewhere");
  const Configuration again = loadConfiguration(write("elsewhere/emitted.yaml", emitYaml(configuration)));
  EXPECT_EQ(configurationHash(again), configurationHash(configuration));
  EXPECT_EQ(cv::countNonZero(again.own_parts), 48);
}

TEST_F(OwnPartsMask, WithoutOneNothingIsLeftOut) { EXPECT_TRUE(load(kCamera).own_parts.empty()); }

TEST_F(OwnPartsMask, AnUnusableOneIsRefusedWithItsPlace) {
  EXPECT_THAT(errorMessage(kMasked), HasSubstr("vehicle.yaml:1: camera.mask: "));
  EXPECT_THAT(errorMessage(kMasked), HasSubstr("parts.png no such file"));
  write("parts.png", "no image");
  EXPECT_THAT(errorMessage(kMasked), HasSubstr("is neither a PNG nor a JPEG image"));
  writeMask(cv::Mat1b(20, 30, uchar{255}));
  EXPECT_THAT(errorMessage(kMasked), HasSubstr("has 30x20 px, the camera 64x48"));
  writeMask(cv::Mat1b(48, 64, uchar{255}));
  EXPECT_THAT(errorMessage(kMasked), HasSubstr("leaves less than a tenth"));
  writeMask(cv::Mat1b(48, 64, uchar{0}));
  EXPECT_THAT(errorMessage(kMasked), HasSubstr("marks nothing"));
}

}  // namespace
}  // namespace redbee::test
