// Features of regions that are drawn, so that each is known.
#include "redbee/detection/objects/region_features.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "redbee/detection/objects/outline_contrast.hpp"
#include "redbee/imaging/chamfer_distance.hpp"

namespace redbee {
namespace {

const cv::Size kMaps(160, 120), kImage(320, 240);

ForegroundMaps emptyMaps() {
  ForegroundMaps maps;
  maps.appearance = cv::Mat1b::zeros(kMaps);
  maps.motion = cv::Mat1b::zeros(kMaps);
  maps.ground = cv::Mat1b::zeros(kMaps);
  maps.colours = cv::Mat4b(kMaps, cv::Vec4b(100, 100, 100, 0));
  return maps;
}

float at(const RegionFeatures& features, RegionFeature feature) {
  return features[static_cast<size_t>(feature)];
}

TEST(RegionFeatures, TellsTheRegionFromWhatIsAroundIt) {
  ForegroundMaps maps = emptyMaps();
  const cv::Rect box(60, 50, 10, 6);
  maps.appearance(box).setTo(200);
  maps.motion(box).setTo(51);
  // 3 to 7 px of the image around it are 1.5 to 3.5 px of the maps, 7 to 16 px are 3.5 to 8.
  maps.ground.setTo(90);
  maps.ground(cv::Rect(box.x - 3, box.y - 3, box.width + 6, box.height + 6)).setTo(30);
  maps.ground(box).setTo(240);
  const RegionFeatures f = RegionMeter(maps, kImage, {}).measure(box, cv::Mat1b(box.size(), 255), 2);
  EXPECT_EQ(at(f, RegionFeature::kLevel), 2);
  EXPECT_FLOAT_EQ(at(f, RegionFeature::kLogArea), std::log(240.0F));
  EXPECT_EQ(at(f, RegionFeature::kFill), 1);
  EXPECT_EQ(at(f, RegionFeature::kAtBorder), 0);
  EXPECT_EQ(at(f, RegionFeature::kGroundOwn), 240);
  EXPECT_EQ(at(f, RegionFeature::kGroundMost), 240);
  EXPECT_EQ(at(f, RegionFeature::kGroundNear), 30);
  EXPECT_NEAR(at(f, RegionFeature::kGroundFar), 90, 3) << "the corners of its surroundings are further away";
  EXPECT_EQ(at(f, RegionFeature::kAppearanceOwn), 200);
  EXPECT_EQ(at(f, RegionFeature::kAppearanceNear), 0);
  EXPECT_EQ(at(f, RegionFeature::kMotionOwn), 51);
  EXPECT_EQ(at(f, RegionFeature::kForegroundOwn), 40);
  EXPECT_TRUE(std::isnan(at(f, RegionFeature::kLogWidth_m))) << "the ground is not known";
}

TEST(RegionFeatures, MeasuresSizesWhereTheLowerEdgeMeetsTheGround) {
  const ForegroundMaps maps = emptyMaps();
  const cv::Rect box(60, 50, 10, 6);
  GroundPlane ground{{0, std::sin(0.5), std::cos(0.5)}, 20, Eigen::Matrix3d::Identity()};
  ground.K << 300, 0, 160, 0, 300, 120, 0, 0, 1;
  const RegionFeatures f = RegionMeter(maps, kImage, ground).measure(box, cv::Mat1b(box.size(), 255), 0);
  // The foot of the box, in the image, and the depth of the plane there.
  const Eigen::Vector3d ray((130.0 - 160) / 300, (112.0 - 120) / 300, 1);
  const double depth_m = 20 / ground.normal.dot(ray);
  EXPECT_NEAR(std::exp(at(f, RegionFeature::kLogWidth_m)), 20 * depth_m / 300, 1e-4);
  EXPECT_NEAR(std::exp(at(f, RegionFeature::kLogHeight_m)), 12 * depth_m / 300, 1e-4);
}

TEST(RegionFeatures, KnowsTheBorder) {
  const ForegroundMaps maps = emptyMaps();
  for (const cv::Rect& box :
       {cv::Rect(0, 50, 8, 8), cv::Rect(152, 50, 8, 8), cv::Rect(50, 0, 8, 8), cv::Rect(50, 112, 8, 8)}) {
    EXPECT_EQ(at(RegionMeter(maps, kImage, {}).measure(box, cv::Mat1b(box.size(), 255), 0),
                 RegionFeature::kAtBorder),
              1);
  }
}

OutlineContrast contrastOf(const cv::Mat4b& colours, const cv::Rect& box) {
  const cv::Rect around(box.x - 9, box.y - 9, box.width + 18, box.height + 18);
  const cv::Mat1b pixels(box.size(), 255);
  cv::Mat1f distance(around.size()), depth(box.size());
  distanceOutside(box - around.tl(), pixels, distance);
  distanceInside(pixels, depth);
  return outlineContrast(colours, box, depth, around, distance, {1.5F, 3.5F});
}

TEST(OutlineContrast, AnObjectOnTheGroundHasItAllAround) {
  cv::Mat4b colours(kMaps, cv::Vec4b(100, 120, 140, 0));
  const cv::Rect box(60, 50, 6, 14);
  colours(box).setTo(cv::Scalar(110, 160, 150));
  const OutlineContrast contrast = contrastOf(colours, box);
  EXPECT_FLOAT_EQ(contrast.least, 40);
  EXPECT_FLOAT_EQ(contrast.second, 40);
  EXPECT_FLOAT_EQ(contrast.median, 40);
  EXPECT_FLOAT_EQ(contrast.mean, 40);
}

TEST(OutlineContrast, APieceOfAPostHasNoneAtItsEnds) {
  for (const bool is_upright : {true, false}) {
    cv::Mat4b colours(kMaps, cv::Vec4b(100, 120, 140, 0));
    const cv::Rect piece = is_upright ? cv::Rect(60, 50, 4, 14) : cv::Rect(60, 50, 14, 4);
    const cv::Rect post = is_upright ? cv::Rect(60, 0, 4, 120) : cv::Rect(0, 50, 160, 4);
    colours(post).setTo(cv::Scalar(20, 20, 20));
    const OutlineContrast contrast = contrastOf(colours, piece);
    EXPECT_LT(contrast.least, 60) << is_upright;
    EXPECT_LT(contrast.second, 60) << is_upright;
    EXPECT_GT(contrast.median, 90) << is_upright;
    EXPECT_LT(contrast.second, 0.5 * contrast.mean) << is_upright;
  }
}

TEST(OutlineContrast, OnePixelHasAnOutline) {
  cv::Mat4b colours(kMaps, cv::Vec4b(100, 100, 100, 0));
  colours(60, 60) = cv::Vec4b(50, 100, 100, 0);
  const OutlineContrast contrast = contrastOf(colours, {60, 60, 1, 1});
  EXPECT_FLOAT_EQ(contrast.least, 50);
}

}  // namespace
}  // namespace redbee
