// live_flight: flies the endless flight (tests/support/endless_flight.hpp) into a running stack, with the
// true POSE, until it is stopped. It writes what DETECTIONS says, a line of JSON a frame: {"utime": us,
// "boxes": [[id, x, y, width, height, seen], ...]}, and what TARGETS says: {"utime": us, "targets": [[id,
// state, east, north], ...]}.
#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <fstream>
#include <string>

#include "processes/common_options.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/node/node.hpp"
#include "redbee/pose_t.hpp"
#include "redbee/targets_t.hpp"
#include "tests/support/live_player.hpp"

namespace redbee::test {
namespace {

constexpr double kLongest_s = 900;
constexpr int64_t kPosePeriod_us = 20'000;

pose_t poseAt(const simulation::Scenario& scenario, int64_t utime) {
  const auto state = scenario.trajectory.at(static_cast<double>(utime - scenario.start.count()) / 1e6);
  const Eigen::Quaterniond q(state.R_GI);
  pose_t pose{};
  pose.utime = utime;
  pose.quat[0] = q.w();
  pose.quat[1] = q.x();
  pose.quat[2] = q.y();
  pose.quat[3] = q.z();
  for (const int i : {0, 4, 8}) pose.attitude_covariance[i] = 1e-4;
  pose.has_local = 1;
  for (int i = 0; i < 3; ++i) pose.local[i] = state.p_GI(i);
  pose.has_home_altitude = 1;
  pose.home_altitude = state.p_GI.z();
  return pose;
}

void write(std::ofstream& out, const detections_t& m) {
  out << "{\"utime\": " << m.utime << ", \"boxes\": [";
  for (size_t i = 0; i < m.detections.size(); ++i) {
    const detection_t& d = m.detections[i];
    out << (i == 0 ? "" : ", ") << "[" << d.id << ", " << d.x << ", " << d.y << ", " << d.width << ", "
        << d.height << ", " << static_cast<int>(d.seen) << "]";
  }
  out << "]}" << std::endl;  // NOLINT: who reads it does so while it is written
}

void write(std::ofstream& out, const targets_t& m) {
  out << "{\"utime\": " << m.utime << ", \"targets\": [";
  for (size_t i = 0; i < m.targets.size(); ++i) {
    const target_t& t = m.targets[i];
    out << (i == 0 ? "" : ", ") << "[" << t.id << ", " << static_cast<int>(t.state) << ", " << t.position[0]
        << ", " << t.position[1] << "]";
  }
  out << "]}" << std::endl;  // NOLINT: as above
}

void fly(const std::string& url, const std::string& file, const std::string& targets_file, double speed) {
  const auto bus = makeLcmBus(url);
  std::ofstream out(file);
  std::ofstream targets_out(targets_file);
  const auto targets =
      bus->subscribe<targets_t>("TARGETS", 64, [&](const targets_t& m) { write(targets_out, m); });
  const auto subscription =
      bus->subscribe<detections_t>("DETECTIONS", 64, [&](const detections_t& m) { write(out, m); });
  const EndlessFlight flight;
  LivePlayer player(*bus, flight, kLongest_s, speed);
  int64_t next_pose = flight.utime(0);
  const std::atomic<bool>& stop = stopOnSignals();
  while (!stop && !player.isOver()) {
    player.publishDue();
    for (; player.frames() > 0 && next_pose <= player.newestUtime(); next_pose += kPosePeriod_us)
      bus->publish("POSE", poseAt(flight.scenario(), next_pose));
    bus->handle(std::chrono::milliseconds(1));
  }
}

}  // namespace
}  // namespace redbee::test

// A tool for us: an exception ends it with its message. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  CLI::App app("Flies the endless flight into a running stack", "live_flight");
  std::string url;
  std::string file;
  std::string targets_file;
  double speed = 1;
  redbee::addLcmUrlOption(app, url);
  app.add_option("--detections", file, "where what DETECTIONS says is written")->required();
  app.add_option("--targets", targets_file, "where what TARGETS says is written");
  app.add_option("--speed", speed, "times the flight's own speed");
  CLI11_PARSE(app, argc, argv);
  redbee::test::fly(url, file, targets_file, speed);
  return 0;
}
