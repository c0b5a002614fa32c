#include "processes/redbee/export/ros_export.hpp"

#include <spdlog/fmt/fmt.h>

#include <array>

#include "processes/redbee/export/cdr_writer.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/importers/ros/ros_encodings.hpp"

namespace redbee {
namespace {

constexpr const char* kCameraFrame = "camera_optical";  ///< x right, y down, z forward
constexpr const char* kImuFrame = "imu";

CdrWriter& writeHeader(CdrWriter& out, int64_t utime, const char* frame) {
  return out.time(utime).string(frame);
}

struct Rgba {
  double r, g, b, a;
};
constexpr Rgba kSeenColour{0.1, 0.9, 0.2, 1};
constexpr Rgba kPredictedColour{0.6, 0.6, 0.6, 1};
constexpr Rgba kClear{0, 0, 0, 0};
constexpr Rgba kShade{0, 0, 0, 0.6};

void write(CdrWriter& out, const Rgba& colour) {
  out.number(colour.r).number(colour.g).number(colour.b).number(colour.a);
}

void writeKeyValue(CdrWriter& out, const std::string& key, const std::string& value) {
  out.string(key).string(value);
}

void writeOutline(CdrWriter& out, int64_t utime, const Detection& box) {
  constexpr uint8_t kLineLoop = 2;
  constexpr double kThickness = 2;  // px
  const double left = box.box.x, top = box.box.y, right = left + box.box.width, bottom = top + box.box.height;
  out.time(utime).number(kLineLoop).number(uint32_t{4});
  for (const auto& [x, y] : {std::pair{left, top}, {right, top}, {right, bottom}, {left, bottom}})
    out.number(x).number(y);
  write(out, box.seen ? kSeenColour : kPredictedColour);
  out.number(uint32_t{0});  // outline_colors
  write(out, kClear);
  out.number(kThickness).number(uint32_t{2});
  writeKeyValue(out, "id", std::to_string(box.id));
  writeKeyValue(out, "score", fmt::format("{:.3f}", box.score));
}

void writeName(CdrWriter& out, int64_t utime, const Detection& box) {
  constexpr double kFontSize = 14;  // px
  out.time(utime).number(double(box.box.x)).number(double(box.box.y));
  out.string(fmt::format("{} {:.2f}", box.id, box.score)).number(kFontSize);
  write(out, box.seen ? kSeenColour : kPredictedColour);
  write(out, kShade);
  out.number(uint32_t{0});  // metadata
}

CdrBytes rawImage(int64_t utime, int32_t width, int32_t height, const std::string& encoding, uint32_t step,
                  ByteView data) {
  CdrWriter out;
  writeHeader(out, utime, kCameraFrame);
  out.number(static_cast<uint32_t>(width)).number(static_cast<uint32_t>(height));
  return out.string(encoding).number(step).data(data).bytes();
}

void writeCovariance(CdrWriter& out, double first) {
  std::array<double, 9> values{};
  values[0] = first;
  out.numbers(values.data(), values.size());
}

}  // namespace

CdrBytes exportCompressedImage(int64_t utime, const std::vector<uint8_t>& data, const std::string& format) {
  CdrWriter out;
  writeHeader(out, utime, kCameraFrame);
  return out.data({data.data(), data.size()}).string(format).bytes();
}

CdrBytes exportRawImage(const image_t& image) {
  const std::string encoding = rosEncodingOf(image.pixelformat);
  if (!encoding.empty() && faultOfImage(image).empty()) {
    return rawImage(image.utime, image.width, image.height, encoding, static_cast<uint32_t>(image.row_stride),
                    {image.data.data(), image.data.size()});
  }
  const auto colour = decodeColour(image);
  if (!colour) return {};
  return rawImage(image.utime, colour->cols, colour->rows, "bgr8", static_cast<uint32_t>(3 * colour->cols),
                  {colour->ptr(), colour->total() * 3});
}

CdrBytes exportBoxes(int64_t utime, const std::vector<Detection>& boxes) {
  const auto count = static_cast<uint32_t>(boxes.size());
  CdrWriter out;
  out.time(utime).number(uint32_t{0}).number(count);  // no circles
  for (const Detection& box : boxes) writeOutline(out, utime, box);
  out.number(count);
  for (const Detection& box : boxes) writeName(out, utime, box);
  return out.number(uint32_t{0}).bytes();  // metadata
}

CdrBytes exportImu(const ins_t& imu) {
  constexpr double kMissing = -1, kNotKnown = 0;
  constexpr std::array<double, 4> kNoTurn{0, 0, 0, 1};
  CdrWriter out;
  writeHeader(out, imu.utime, kImuFrame).numbers(kNoTurn.data(), kNoTurn.size());
  writeCovariance(out, kMissing);
  out.numbers(imu.gyro, 3);
  writeCovariance(out, kNotKnown);
  out.numbers(imu.accel, 3);
  writeCovariance(out, kNotKnown);
  return out.bytes();
}

CdrBytes exportRange(const altimeter_t& altitude) {
  constexpr uint8_t kInfrared = 1;
  CdrWriter out;
  writeHeader(out, altitude.utime, kCameraFrame).number(kInfrared).number(0.F);
  // Without limits: they are not known.
  out.number(0.F).number(0.F).number(static_cast<float>(altitude.height));
  return out.number(static_cast<float>(altitude.sigma * altitude.sigma)).bytes();
}

CdrBytes exportCameraInfo(int64_t utime, const CameraIntrinsics& camera) {
  const std::array<double, 9> K{camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  const std::array<double, 9> R{1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::array<double, 12> P{camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  CdrWriter out;
  writeHeader(out, utime, kCameraFrame);
  out.number(static_cast<uint32_t>(camera.height)).number(static_cast<uint32_t>(camera.width));
  out.string(camera.model == "radtan" ? "plumb_bob" : camera.model);  // ROS's name
  out.number(static_cast<uint32_t>(camera.distortion.size()));
  out.numbers(camera.distortion.data(), camera.distortion.size());
  out.numbers(K.data(), K.size()).numbers(R.data(), R.size()).numbers(P.data(), P.size());
  for (int i = 0; i < 6; ++i) out.number(uint32_t{0});  // binning, region of interest
  return out.number(uint8_t{0}).bytes();
}

CdrBytes exportHealth(const process_health_t& health) {
  CdrWriter out;
  out.time(health.utime).number(health.state).number(health.rate_in).number(health.rate_out);
  out.number(health.latency_median)
      .number(health.latency_p99)
      .number(health.work_median)
      .number(health.work_p99);
  for (const int64_t count : {health.received, health.published, health.skipped, health.lost, health.damaged,
                              health.late, health.resident})
    out.number(count);
  return out.string(health.message).bytes();
}

CdrBytes exportLog(const process_health_t& health) {
  constexpr uint8_t kInfo = 2, kWarning = 3, kError = 4;
  const bool is_fault = health.state == process_health_t::DEAD;
  const bool is_degraded = health.state == process_health_t::DEGRADED;
  CdrWriter out;
  out.time(health.utime).number(is_fault ? kError : is_degraded ? kWarning : kInfo);
  return out.string(health.message).string(health.process).string("").number(uint32_t{0}).bytes();
}

}  // namespace redbee
