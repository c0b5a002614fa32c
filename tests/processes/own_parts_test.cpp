// A camera that sees its own drone: a propeller that flickers in one corner, an arm that stands still in
// another. With camera.mask they are left out, and the rest is as without them.
#include "tests/support/own_parts.hpp"

#include <gtest/gtest.h>

#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "processes/redbee/mosaic/make_mosaic.hpp"
#include "redbee/files/atomic_file.hpp"
#include "redbee/files/log.hpp"
#include "redbee/imaging/rectifier.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 72;
constexpr int kSettled = 16;  ///< the background is known by then

struct Figures {
  double worst_px = 0;  ///< of the ground's homography by vision
  int tracks_on_parts = 0;
  int mask_on_parts = 0;  ///< px
  int unknown_on_parts = 0;
  int false_px = 0;  ///< px of masks beside movers
  int found_px = 0;  ///< px of movers in masks
};

Figures fly(const StackFlight& flight) {
  const cv::Mat1b parts = maskOfParts();
  const StackOutput output = StackRun(flight).run();
  Figures figures;
  for (int k = kSettled; k < kFrames; ++k) {
    const int64_t utime = flight.frame_utimes[static_cast<size_t>(k)];
    const visual_homography_t& visual = output.visual.at(utime);
    figures.worst_px = std::max(
        figures.worst_px, groundError(output.fused.at(utime), flight.homographies[static_cast<size_t>(k)]));
    for (int i = 0; i < visual.tracks.n; ++i) {
      const cv::Point at(cvRound(visual.tracks.x[static_cast<size_t>(i)]),
                         cvRound(visual.tracks.y[static_cast<size_t>(i)]));
      figures.tracks_on_parts += parts(at) != 0 ? 1 : 0;
    }
    const foreground_t& m = output.foreground.at(utime);
    const cv::Mat1b mask = cv::imdecode(m.mask, cv::IMREAD_GRAYSCALE);
    const cv::Mat1b truth = flight.masks[static_cast<size_t>(k)] != 0;
    figures.mask_on_parts += cv::countNonZero(mask & parts);
    figures.unknown_on_parts += cv::countNonZero(cv::imdecode(m.unknown, cv::IMREAD_GRAYSCALE) & parts);
    cv::Mat1b near;
    cv::dilate(truth, near, cv::Mat(), {-1, -1}, 8);
    figures.false_px += cv::countNonZero(mask & ~near);
    figures.found_px += cv::countNonZero(mask & truth & ~parts);
  }
  std::cout << "worst ground error " << figures.worst_px << " px, " << figures.tracks_on_parts
            << " tracks on the parts, mask " << figures.mask_on_parts << " px on them, " << figures.false_px
            << " px false in all, " << figures.found_px << " px of movers\n";
  return figures;
}

void expectLeftOut(const simulation::Scenario& scenario) {
  StackFlight flight = flightWithParts(scenario, kFrames);
  const Figures seen = fly(flight);
  flight.configuration.own_parts = maskOfParts();
  const Figures left_out = fly(flight);
  EXPECT_GT(seen.tracks_on_parts, 0) << "the trial has no difficulty";
  EXPECT_GT(seen.mask_on_parts, 1000) << "the trial has no difficulty";
  EXPECT_EQ(left_out.tracks_on_parts, 0);
  EXPECT_EQ(left_out.mask_on_parts, 0);
  EXPECT_EQ(left_out.unknown_on_parts, (kFrames - kSettled) * cv::countNonZero(maskOfParts()));
  EXPECT_LT(left_out.worst_px, 1);
  EXPECT_LT(left_out.false_px, seen.false_px / 4);
  EXPECT_GT(left_out.found_px, 0);
}

TEST(OwnParts, AreLeftOutOfTracksAndMasks) { expectLeftOut(simulation::walkers(2)); }

/// Those of a lens that zooms grow with it.
TEST(OwnParts, AreLeftOutWhereTheLensZooms) {
  simulation::Scenario scenario = simulation::walkers(2);
  scenario.lens = simulation::zoomWalkers(2).lens;
  StackFlight flight = stackFlight(scenario, kFrames);
  flight.configuration.own_parts = maskOfParts();
  const StackOutput output = StackRun(flight).run();
  const Rectifier rectifier(Camera(scenario.intrinsics), maskOfParts());
  int zoomed_in = 0;
  for (int k = kSettled; k < kFrames; ++k) {
    const int64_t utime = flight.frame_utimes[static_cast<size_t>(k)];
    const visual_homography_t& visual = output.visual.at(utime);
    zoomed_in += visual.zoom > 1.2 ? 1 : 0;
    const cv::Mat1b parts = rectifier.ownParts({std::nullopt, visual.zoom});
    const cv::Mat1b unknown = cv::imdecode(output.foreground.at(utime).unknown, cv::IMREAD_GRAYSCALE);
    EXPECT_EQ(cv::countNonZero(parts & ~unknown), 0) << k;
    int on_parts = 0;
    for (size_t i = 0; i < visual.tracks.x_previous.size(); ++i) {
      const cv::Point at(cvRound(visual.tracks.x_previous[i]), cvRound(visual.tracks.y_previous[i]));
      on_parts += parts(at) != 0 ? 1 : 0;
    }
    EXPECT_EQ(on_parts, 0) << k;
  }
  EXPECT_GT(zoomed_in, 10);
}

/// A part as white as nothing on the ground is.
int whitePixels(const ScratchFolder& folder, const Configuration& configuration, bool is_masked) {
  std::string yaml = emitYaml(configuration);
  if (is_masked) {
    const std::string key = "  mask: \"\"";
    const size_t at = yaml.find(key);
    EXPECT_NE(at, std::string::npos);
    yaml.replace(at, key.size(), "  mask: \"parts.png\"");
  }
  writeText(folder / "vehicle.yaml", yaml);
  MosaicOptions options;
  options.log = folder / "flight.lcm";
  options.configuration = folder / "vehicle.yaml";
  options.out = folder / (is_masked ? "masked" : "plain");
  makeMosaic(options);
  const cv::Mat3b mosaic = cv::imread((options.out / "mosaic.png").string(), cv::IMREAD_COLOR);
  return cv::countNonZero(cv::Mat1b(mosaic.reshape(1) > 250));
}

TEST(OwnParts, AreNotOnTheMosaic) {
  const ScratchFolder folder;
  StackFlight flight = stackFlight(simulation::walkers(2), 48);
  LogWriter log(folder / "flight.lcm");
  for (SensorMessage& sent : flight.messages) {
    if (sent.channel == "CAMERA") {
      image_t image;
      image.decode(sent.data.data(), 0, static_cast<int>(sent.data.size()));
      cv::Mat1b grey = decodeGrey(image)->clone();
      grey(kArm).setTo(255);
      sent = encoded(rawGreyMessage(image.utime, grey));
    }
    log.write(sent.utime, sent.channel, sent.data);
  }
  log.close();
  cv::imwrite((folder / "parts.png").string(), maskOfParts());
  const int seen = whitePixels(folder, flight.configuration, false);
  const int left_out = whitePixels(folder, flight.configuration, true);
  std::cout << "white on the mosaic: " << seen << ", with camera.mask " << left_out << " values\n";
  EXPECT_GT(seen, 3000) << "the trial has no difficulty";
  EXPECT_LT(left_out, seen / 100);
}

}  // namespace
}  // namespace redbee::test
