// What a bus and its other users do to the stack: loss, doubles, disorder, floods, strangers, clocks, stalls.
#include <gtest/gtest.h>

#include <random>

#include "tests/processes/allocated_bytes.hpp"
#include "tests/processes/fault_trial.hpp"
#include "tests/processes/lossy_bus.hpp"
#include "tests/processes/mortal_stack.hpp"

namespace redbee::test {
namespace {

Said runLossy(const Flight& flight, const PacketFaults& faults, unsigned seed) {
  const auto bus = makeLcmBus("memq://");
  LossyBus lossy(*bus, faults, seed);
  Said said = run(flight, lossy,
                  [&](const Arrival& arrival) { lossy.disturbed = isDisturbed(flight, arrival.utime); });
  EXPECT_EQ(lossy.handlerFailures(), 0);
  return said;
}

void expectAllKindsSurvived(double share, int within_frames) {
  const int percent = static_cast<int>(std::lround(100 * share));
  const struct {
    const char* name;
    PacketFaults faults;
  } kinds[] = {{"lost", {share, 0, 0}},
               {"duplicated", {0, share, 0}},
               {"reordered", {0, 0, share}},
               {"lost, duplicated, reordered", {share, share, share}}};
  unsigned seed = 1;
  for (const auto& kind : kinds) {
    const Said said = runLossy(calmFlight(), kind.faults, seed++);
    expectRecovery(std::to_string(percent) + " % " + kind.name, said, calmFlight(), within_frames);
  }
}

TEST(BusFault, UndisturbedRunsAgree) {
  const Damage damage = assess(run(calmFlight()), calmFlight());
  EXPECT_EQ(damage.frames_to_recovery, 0);
  EXPECT_EQ(damage.without_mask, 0);
  EXPECT_LT(damage.worst_px, 0.3);
}

TEST(BusFault, OnePercentOfPackets) { expectAllKindsSurvived(0.01, 24); }
TEST(BusFault, FivePercentOfPackets) { expectAllKindsSurvived(0.05, 24); }
TEST(BusFault, TwentyPercentOfPackets) { expectAllKindsSurvived(0.2, 24); }

TEST(BusFault, RandomBytesOnEveryChannel) {
  Flight flight = calmFlight();
  std::mt19937 random(7);
  const Channels& c = flight.configuration.channels;
  std::vector<Arrival> with_rubbish;
  for (const Arrival& arrival : flight.arrivals) {
    with_rubbish.push_back(arrival);
    if (!isDisturbed(flight, arrival.utime) || arrival.channel != "CAMERA") continue;
    for (const std::string& channel : {c.camera, c.imu, c.altimeter, c.inertial_homography, c.filter_snapshot,
                                       c.warm_start, c.visual_homography, c.fused_homography}) {
      std::vector<uint8_t> rubbish(std::uniform_int_distribution<size_t>(0, 2000)(random));
      for (uint8_t& byte : rubbish) byte = static_cast<uint8_t>(random());
      with_rubbish.push_back({arrival.utime, channel, rubbish});
    }
  }
  flight.arrivals = with_rubbish;
  const Said said = run(flight);
  expectRecovery("random bytes on every channel", said, flight, 0);
  EXPECT_GE(said.health.at("redbee-imu-integration").damaged, kFaultEnd - kFaultBegin);
}

/// Right on the wire, wrong in what they say: a bit flipped anywhere behind the hash.
TEST(BusFault, FlippedBitsInEveryKindOfMessage) {
  Flight flight = calmFlight();
  std::mt19937 random(8);
  for (Arrival& arrival : flight.arrivals) {
    if (!isDisturbed(flight, arrival.utime) || random() % 20 != 0) continue;
    const size_t at = kHashBytes + random() % std::min<size_t>(arrival.data.size() - kHashBytes, 120);
    arrival.data[at] = static_cast<uint8_t>(arrival.data[at] ^ (1U << (random() % 8)));
  }
  expectRecovery("a bit flipped in 5 % of messages", run(flight), flight, 30);
}

TEST(BusFault, TimesThatNoClockShows) {
  Flight flight = calmFlight();
  std::mt19937 random(9);
  const int64_t times[] = {
      std::numeric_limits<int64_t>::max(),    std::numeric_limits<int64_t>::min(),   0, -1,
      flight.frame_utimes[0] + 3'600'000'000, flight.frame_utimes[0] - 3'600'000'000};
  std::vector<Arrival> arrivals;
  for (const Arrival& arrival : flight.arrivals) {
    arrivals.push_back(arrival);
    if (!isDisturbed(flight, arrival.utime) || random() % 20 != 0 || arrival.channel != "IMU") continue;
    ins_t stray;
    ASSERT_TRUE(decodeMessage(arrival.data.data(), static_cast<int>(arrival.data.size()), stray));
    stray.utime = times[random() % 6];
    arrivals.push_back(arrivalOf(stray));
  }
  flight.arrivals = arrivals;
  expectRecovery("IMU times that no clock shows", run(flight), flight, 0);
}

TEST(BusFault, ACameraTimeThatNoClockShows) {
  for (const int64_t utime : {std::numeric_limits<int64_t>::max(), std::numeric_limits<int64_t>::min(),
                              calmFlight().frame_utimes[0] + 3'600'000'000}) {
    Flight flight = calmFlight();
    const Arrival first = *std::find_if(
        flight.arrivals.begin(), flight.arrivals.end(),
        [&](const Arrival& a) { return a.channel == "CAMERA" && a.utime == beginTime(flight); });
    image_t stray;
    ASSERT_TRUE(decodeMessage(first.data.data(), static_cast<int>(first.data.size()), stray));
    stray.utime = utime;
    const auto place = std::find_if(flight.arrivals.begin(), flight.arrivals.end(),
                                    [&](const Arrival& a) { return a.utime >= beginTime(flight); });
    flight.arrivals.insert(place, {beginTime(flight), "CAMERA", encodeMessage(stray)});
    expectRecovery("one camera time that no clock shows", run(flight), flight, 24);
  }
}

/// The clock of all sensors jumps ahead by five seconds for the stretch, and back after it.
TEST(BusFault, ClocksThatJumpAheadAndBack) {
  Flight flight = calmFlight();
  const auto shifted = [](int64_t utime) { return utime + 5'000'000; };
  flight = withChanged<image_t>(flight, "CAMERA", [&](image_t& m) { m.utime = shifted(m.utime); });
  flight = withChanged<ins_t>(flight, "IMU", [&](ins_t& m) { m.utime = shifted(m.utime); });
  flight = withChanged<altimeter_t>(flight, "ALTIMETER", [&](altimeter_t& m) { m.utime = shifted(m.utime); });
  expectRecovery("clocks jump 5 s ahead and back", run(flight), flight, 30);
}

TEST(BusFault, TheImusClockAloneJumps) {
  const Flight flight = withChanged<ins_t>(calmFlight(), "IMU", [](ins_t& m) { m.utime += 3'600'000'000; });
  expectRecovery("the IMU's clock is an hour ahead", run(flight), flight, 30);
}

Flight withSecondPublisher(const std::string& channel, int64_t delay_us) {
  Flight flight = calmFlight();
  std::vector<Arrival> both = flight.arrivals;
  for (const Arrival& arrival : flight.arrivals) {
    if (arrival.channel != channel || !isDisturbed(flight, arrival.utime)) continue;
    Arrival other = arrival;
    if (channel == "CAMERA") {
      cv::Mat noise(kFaultHeight, kFaultWidth, CV_8U);
      cv::RNG(static_cast<uint64_t>(arrival.utime)).fill(noise, cv::RNG::UNIFORM, 0, 255);
      other = arrivalOf(rawGreyMessage(arrival.utime + delay_us, noise));
    } else {
      ins_t wrong{};
      wrong.utime = arrival.utime + delay_us;
      wrong.accel[2] = 9.81;
      other = arrivalOf(wrong);
    }
    both.push_back(other);
  }
  std::stable_sort(both.begin(), both.end(),
                   [](const Arrival& a, const Arrival& b) { return a.utime < b.utime; });
  flight.arrivals = both;
  return flight;
}

TEST(BusFault, TwoPublishersOnOneChannel) {
  const Flight cameras = withSecondPublisher("CAMERA", 17'000);
  expectRecovery("a second camera on CAMERA", run(cameras), cameras, 30);
  const Flight imus = withSecondPublisher("IMU", 1'000);
  expectRecovery("a second, resting IMU on IMU", run(imus), imus, 30);
}

/// The whole stack started twice by mistake: two of everyone speak on every channel.
TEST(BusFault, TwoStacksAtOnce) {
  const Flight& flight = calmFlight();
  const auto bus = makeLcmBus("memq://");
  std::unique_ptr<MortalStack> second;
  bool over = false;
  const Said said = run(flight, *bus, [&](const Arrival& arrival) {
    if (!second && isDisturbed(flight, arrival.utime)) {
      second = std::make_unique<MortalStack>(*bus, flight.configuration);
    }
    if (second && !over && arrival.utime >= endTime(flight)) {
      for (const ProcessDescription* stage : kStages) second->kill(*stage);
      over = true;
    }
    if (second && !over) second->settle();
  });
  expectRecovery("the stack runs twice", said, flight, 24);
}

Arrival laterBy(const Arrival& arrival, int64_t us) {
  Arrival later = arrival;
  later.utime += us;
  const auto number = static_cast<uint64_t>(later.utime);
  for (int i = 0; i < 8; ++i)
    later.data[kHashBytes + static_cast<size_t>(i)] = static_cast<uint8_t>(number >> (56 - 8 * i));
  return later;
}

/// Thousands of messages, each a microsecond newer than the last, before any node gets to work on one.
TEST(BusFault, AFloodIsSkippedNotQueued) {
  const Flight& flight = calmFlight();
  for (const std::string& channel : {std::string("CAMERA"), std::string("IMU"), std::string("ALTIMETER")}) {
    const auto bus = makeLcmBus("memq://");
    const Arrival sample =
        *std::find_if(flight.arrivals.begin(), flight.arrivals.end(),
                      [&](const Arrival& a) { return a.channel == channel && a.utime >= beginTime(flight); });
    bool flooded = false;
    int64_t grown = 0;
    const Said said = run(flight, *bus, [&](const Arrival& arrival) {
      if (flooded || arrival.utime < beginTime(flight)) return;
      flooded = true;
      const int64_t before = allocatedBytes();
      for (int i = 0; i < 20000; ++i) {
        bus->publish(channel, laterBy(sample, i).data);
        bus->handle(std::chrono::milliseconds(0));
      }
      grown = allocatedBytes() - before;
    });
    // 20000 images are 1.5 GB; what a queue of frames and the bus itself may hold is far below.
    EXPECT_LT(grown, int64_t{32} << 20) << channel << ": the backlog must be bounded";
    std::printf("20000 messages on %s cost %.1f MB\n", channel.c_str(), static_cast<double>(grown) / 1e6);
    expectRecovery("20000 messages on " + channel, said, flight, 24);
  }
}

/// A segmentation that is stopped for a third of a second at a time while everyone else goes on.
TEST(BusFault, ASlowSubscriberSkipsAndHoldsNobodyUp) {
  const Flight& flight = calmFlight();
  const auto bus = makeLcmBus("memq://");
  Said said;
  const auto keep = [](auto& into) { return [&into](const auto& m) { into[m.utime] = m; }; };
  bus->subscribe<fused_homography_t>("FUSED_HOMOGRAPHY", 64, keep(said.fused), nullptr);
  bus->subscribe<foreground_t>("FOREGROUND", 64, keep(said.foreground), nullptr);
  const Nodes quick = motionNodes(*bus, flight.configuration);
  const auto segmentation = makeNode(kMotionSegmentation, *bus, flight.configuration);
  for (const Arrival& arrival : flight.arrivals) {
    bus->publish(arrival.channel, arrival.data);
    const bool stalled = isDisturbed(flight, arrival.utime);
    do {
      for (const auto& node : quick) node->process();
      if (!stalled) segmentation->process();
    } while (bus->handle(std::chrono::milliseconds(0)) > 0);
  }
  segmentation->finish();
  bus->handle(std::chrono::milliseconds(0));
  expectRecovery("segmentation stalls for a second", said, flight, 24);
  const int backlog = flight.configuration.waits.max_backlog;
  EXPECT_GE(segmentation->health().skipped(), kFaultEnd - kFaultBegin - backlog);
  for (int k = kFaultBegin; k < kFaultEnd; ++k) {
    EXPECT_EQ(said.fused.count(flight.frame_utimes[static_cast<size_t>(k)]), 1U) << "frame " << k;
  }
}

}  // namespace
}  // namespace redbee::test
