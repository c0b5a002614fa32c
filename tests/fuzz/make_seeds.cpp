// make_seeds FOLDER: writes a few small, valid inputs for every fuzz target into FOLDER/<target>/, from the
// simulator and our own writers. scripts/fuzz --seeds calls it; its output is tests/fuzz/corpus.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "processes/conversions.hpp"
#include "processes/in_process_stack.hpp"
#include "redbee/altimeter_t.hpp"
#include "redbee/bus/codec.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/files/log.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/process_health_t.hpp"
#include "redbee/results/video_writer.hpp"
#include "tests/bus/sample_messages.hpp"
#include "tests/fuzz/fuzz_input.hpp"
#include "tests/fuzz/gpmf_seed.hpp"
#include "tests/fuzz/imu_table_seed.hpp"
#include "tests/fuzz/mavlink_seed.hpp"
#include "tests/fuzz/mcap_seed.hpp"
#include "tests/fuzz/small_vehicle.hpp"
#include "tests/fuzz/target_seeds.hpp"

namespace redbee::fuzz {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<uint8_t>;

void write(const fs::path& file, const std::string& content) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << content;
}
void write(const fs::path& file, const Bytes& content) {
  write(file, std::string(content.begin(), content.end()));
}

/// A message of a recording: time, channel's number in messages_fuzz, bytes.
struct Event {
  int64_t utime;
  uint8_t channel;
  std::string name;
  Bytes data;
};

std::vector<Event> inputs() {
  const simulation::FlightSimulator simulator(smallScenario());
  std::vector<Event> events;
  const ImuTime begin = toImu(simulator.frameTime(0), Duration(0));
  const ImuTime end = toImu(simulator.frameTime(simulator.scenario().frames), Duration(0));
  for (const ImuSample& sample : simulator.imu()) {
    if (sample.time < begin - std::chrono::milliseconds(20) || sample.time > end) continue;
    ins_t m{};
    m.utime = toUtime(sample.time);
    for (int i = 0; i < 3; ++i) {
      m.gyro[i] = sample.gyro(i);
      m.accel[i] = sample.accel(i);
    }
    events.push_back({m.utime, 1, "IMU", encodeMessage(m)});
  }
  for (const AltitudeSample& sample : simulator.altimeter()) {
    if (sample.time < begin || sample.time > end) continue;
    events.push_back({toUtime(sample.time), 2, "ALTIMETER",
                      encodeMessage(altimeter_t{toUtime(sample.time), sample.height_m, sample.sigma_m})});
  }
  for (int k = 0; k < simulator.scenario().frames; ++k) {
    const auto frame = simulator.frame(k);
    const image_t m = k == 3 ? jpegMessage(toUtime(frame.time), frame.image.grey, 80)
                             : rawGreyMessage(toUtime(frame.time), frame.image.grey);
    events.push_back({m.utime, 0, "CAMERA", encodeMessage(m)});
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.utime < b.utime; });
  return events;
}

/// The stack's own messages of the flight.
std::vector<Event> outputs(const std::vector<Event>& events) {
  const auto bus = makeLcmBus("memq://");
  std::vector<Event> output;
  const char* const names[] = {"INERTIAL_HOMOGRAPHY", "VISUAL_HOMOGRAPHY", "FUSED_HOMOGRAPHY", "FOREGROUND",
                               "DETECTIONS",          "PROCESS_HEALTH",    "FILTER_SNAPSHOT"};
  std::vector<Subscription> subscriptions;
  for (size_t i = 0; i < std::size(names); ++i) {
    subscriptions.push_back(bus->subscribe(names[i], 64, [&output, i, &names](const uint8_t* data, int size) {
      output.push_back({0, static_cast<uint8_t>(3 + i), names[i], Bytes(data, data + size)});
    }));
  }
  InProcessStack stack(*bus, smallVehicle());
  for (const Event& event : events) {
    bus->publish(event.name, event.data);
    stack.settle();
  }
  stack.finish();
  stack.publishHealth();
  return output;
}

/// Messages to an inertial process at the flight's first frame.
Event keptState(const std::vector<Event>& flight) {
  constexpr uint8_t kWarmStart = 7;
  FilterSnapshot known;
  const int64_t utime =
      std::find_if(flight.begin(), flight.end(), [](const Event& e) { return e.name == "CAMERA"; })->utime;
  known.time = CameraTime(fromUtime(utime));
  known.height_m = 5;
  known.height_sigma_m = 0.1;
  known.R_CI = smallVehicle().inertial.extrinsics.R_CI;
  return {utime, kWarmStart, "WARM_START",
          encodeMessage(messageOf(known, configurationHash(smallVehicle())))};
}

void appendRecord(Bytes& seed, const Event& event) {
  const size_t length = event.data.size() - kHashBytes;
  seed.push_back(event.channel);
  seed.push_back(static_cast<uint8_t>(length >> 8));
  seed.push_back(static_cast<uint8_t>(length & 255));
  seed.insert(seed.end(), event.data.begin() + kHashBytes, event.data.end());
}

void writeMessageSeeds(const fs::path& folder, const std::vector<Event>& flight,
                       const std::vector<Event>& output) {
  Bytes whole;
  for (const Event& event : flight) appendRecord(whole, event);
  write(folder / "messages" / "flight", whole);
  Bytes strangers;
  for (const Event& event : output) {
    if (event.channel <= 5 && event.data.size() < 8000) appendRecord(strangers, event);
    if (strangers.size() > 6000) break;
  }
  write(folder / "messages" / "homographies", strangers);
  Bytes begun;
  for (const Event& event : flight) {
    if (event.utime > keptState(flight).utime) break;
    appendRecord(begun, event);
  }
  appendRecord(begun, keptState(flight));
  write(folder / "messages" / "warm_start", begun);
}

template <typename... Messages>
void writeCodecSeeds(const fs::path& folder, TypeList<Messages...>) {
  uint8_t pick = 0;
  const auto seedOf = [&](const Bytes& encoded) {
    Bytes seed = {pick++};
    seed.insert(seed.end(), encoded.begin() + kHashBytes, encoded.end());
    return seed;
  };
  (write(folder / "codec" / Messages::getTypeName(), seedOf(encodeMessage(test::sample<Messages>()))), ...);
}

void writeLogSeed(const fs::path& folder, const std::vector<Event>& flight) {
  fs::create_directories(folder / "log");
  LogWriter log(folder / "log" / "flight");
  for (const Event& event : flight) {
    if (log.bytes() < 3000) log.write(event.utime, event.name, event.data);
  }
  log.close();
}

std::string imuRows(int64_t from_ns) {
  std::ostringstream rows;
  for (int i = 0; i < 8; ++i) rows << from_ns + i * 5'000'000 << ",0.01,-0.02,0.03,0.1,-0.2,9.8\n";
  return rows.str();
}

void writeTableSeeds(const fs::path& folder) {
  const std::string asl =
      "#timestamp [ns],filename\n1000000000,0.png\n\n%%\n#timestamp,w,w,w,a,a,a\n" + imuRows(990'000'000) +
      "\n%%\n#timestamp [ns],height [m],sigma [m]\n995000000,5,0.1\n\n%%\n"
      "sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [0,0,1,0, -1,0,0,0, 0,-1,0,0, 0,0,0,1]\n"
      "rate_hz: 20\nresolution: [8, 8]\ncamera_model: pinhole\nintrinsics: [8, 8, 3.5, 3.5]\n"
      "distortion_model: radial-tangential\ndistortion_coefficients: [0.1, 0.01, 0, 0]\n\n%%\n"
      "sensor_type: imu\ngyroscope_noise_density: 1e-4\naccelerometer_noise_density: 2e-3\n";
  write(folder / "asl" / "folder", asl);
  write(folder / "csv" / "video_imu",
        "t_s,gx,gy,gz,ax,ay,az\n0,0.1,0.2,0.3,0,0,9.81\n0.005,0.1,0.2,0.3,0,0,9.81\n");
  write(folder / "csv" / "target_imu", imuRows(1));
  write(folder / "csv" / "target_corners",
        "1000,6,6,0.088,0.3,100.5,200.25,0,0,0,0,0\n1000,6,6,0.088,0.3,110.5,200.25,0.088,0,0,0,1\n");
  write(folder / "configuration" / "whole", emitYaml(smallVehicle()));
  write(folder / "configuration" / "short",
        "preset: paper\ncamera: {width: 854, height: 480, fx: 600, fy: 600, cx: 426.5, cy: 239.5}\nimu: "
        "{present: false}\n");
}

void writeVideoSeed(const fs::path& folder) {
  fs::create_directories(folder / "video");
  VideoWriter video(folder / "video" / "clip.mp4", cv::Size(32, 32), 24);
  for (int k = 0; k < 4; ++k) video.write(cv::Mat(32, 32, CV_8U, cv::Scalar(40 * k)));
  video.close();
  fs::rename(folder / "video" / "clip.mp4", folder / "video" / "clip");
}

void writeMcapSeeds(const fs::path& folder) {
  const auto messages = exportedMessages(smallVehicle().camera);
  writeMcapFile(folder / "mcap" / "compressed", messages, 0);
  writeMcapFile(folder / "mcap" / "raw", messages, 1);
  write(folder / "mcap" / "without_chunks", mcapWithoutChunks(messages, 1));
  for (const ExportedMessage& message : messages) write(folder / "ros" / message.name, message.rosSeed());
}

}  // namespace
}  // namespace redbee::fuzz

// A tool for us: an exception ends it with its message. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  using namespace redbee::fuzz;  // NOLINT: a program of one page
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_seeds FOLDER\n");
    return 2;
  }
  const fs::path folder = argv[1];
  const auto flight = inputs();
  writeMessageSeeds(folder, flight, outputs(flight));
  writeCodecSeeds(folder, redbee::MessageTypes{});
  writeLogSeed(folder, flight);
  writeTableSeeds(folder);
  write(folder / "gpmf" / "two_payloads", gpmfSeed());
  writeVideoSeed(folder);
  writeMcapSeeds(folder);
  for (const auto& [name, text] : imuTableSeeds()) write(folder / "imu_table" / name, text);
  write(folder / "mavlink" / "one_second", mavlinkSeed());
  write(folder / "targets" / "walker", targetsSeed(false));
  write(folder / "targets" / "walker_gimbal", targetsSeed(true));
  write(folder / "ground_link" / "commands", groundLinkSeed());
  return 0;
}
