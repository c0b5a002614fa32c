#include "processes/redbee/evaluate/overlay_video.hpp"

#include <gtest/gtest.h>

#include "processes/redbee/vehicle/vehicle_file.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/files/log.hpp"
#include "redbee/image_codec/png.hpp"
#include "redbee/importers/video_reader.hpp"
#include "redbee/results/run_folder.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

const std::vector<int64_t> kUtimes = {1'000'000, 1'041'667, 1'083'333,
                                      1'250'000, 1'250'700, 2'000'000};  // variable

OverlayOptions makeRun(const ScratchFolder& folder) {
  const RunFolder run(folder / "run");
  run.prepare();
  LogWriter log(folder / "f.lcm");
  for (const int64_t utime : kUtimes) {
    log.write("CAMERA", jpegMessage(utime, texture(96, 64, 0, 3), 90));
    const std::vector<uint8_t> png = encodePng(cv::Mat1b(64, 96, uint8_t{0}));
    run.write(RunMap::kMask, utime, {reinterpret_cast<const char*>(png.data()), png.size()});
  }
  log.close();
  run.createDetections().close();
  VehicleDescription vehicle;
  vehicle.name = "v";
  vehicle.width = 96;
  vehicle.height = 64;
  ImportSummary summary;
  summary.vehicle = vehicle;
  assumeIntrinsics(summary);
  return {folder / "f.lcm",
          writeVehicleFile(summary.vehicle, folder / "f.lcm"),
          folder / "run",
          folder / "o.mp4",
          {}};
}

TEST(OverlayVideo, EveryFrameIsShownAtItsOwnTime) {
  const ScratchFolder folder;
  const OverlayOptions options = makeRun(folder);
  renderOverlay(options);
  VideoReader video(options.video, {});
  size_t k = 0;
  int64_t largest_us = 0;
  for (; auto frame = video.next(); ++k)
    largest_us = std::max(largest_us, std::abs(frame->utime - (kUtimes.at(k) - kUtimes.at(0))));
  EXPECT_EQ(k, kUtimes.size());
  std::cout << "largest difference of a frame's time: " << largest_us << " us\n";
  EXPECT_LT(largest_us, 20);
}

TEST(OverlayVideo, TheFlightIsNotOverwritten) {
  const ScratchFolder folder;
  OverlayOptions options = makeRun(folder);
  options.video = options.log;
  const std::string before = readText(options.log);
  EXPECT_NE(errorMessageOf([&] { renderOverlay(options); }).find("is also the input"), std::string::npos);
  EXPECT_TRUE(readText(options.log) == before);
}

}  // namespace
}  // namespace redbee::test
