// redbee-ground-link on a simulated link: what it sends of DETECTIONS and TARGETS, and what its health says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <deque>

#include "processes/ground_link/node.hpp"
#include "tests/support/target_flight.hpp"

namespace redbee::test {
namespace {

using mavlink::Bytes;
using testing::HasSubstr;

struct Station {
  int64_t now_ns = 100'000'000'000;
  std::string fault;
  bool is_open = false;
  std::deque<Bytes> to_send;
  mavlink::Parser parser;
};

class StationLink : public Link {
 public:
  explicit StationLink(Station& station) : station_(station) {}
  std::string open() override {
    station_.is_open = station_.fault.empty();
    return station_.fault;
  }
  bool isOpen() const override { return station_.is_open; }
  ReceivedBytes receive(std::chrono::milliseconds) override {
    station_.now_ns += 20'000'000;
    ReceivedBytes received;
    received.host_ns = station_.now_ns;
    if (station_.to_send.empty()) return received;
    received.data = station_.to_send.front();
    station_.to_send.pop_front();
    return received;
  }
  bool send(const Bytes& data) override {
    station_.parser.feed(data.data(), data.size());
    return true;
  }
  bool isDatagram() const override { return true; }

 private:
  Station& station_;
};

class GroundLinkNodeTest : public testing::Test {
 protected:
  GroundLinkNodeTest() {
    Configuration configuration = TargetFlight::configuration();
    configuration.ground_link.link = "udpout:127.0.0.1:14550";
    node_ = std::make_unique<GroundLinkNode>(*bus_, configuration, std::make_unique<StationLink>(station_),
                                             [this] { return station_.now_ns; });
  }
  void publish() {
    bus_->publish("DETECTIONS", TargetFlight{}.detections(1'000'000, 1, 0));
    while (bus_->handle(std::chrono::milliseconds(0))) {
    }
  }
  targets_t targets(int8_t has_global) {
    targets_t m{};
    m.has_global = has_global;
    m.has_view = 1;
    m.camera_height = 40;
    m.n = 1;
    m.targets.resize(1);
    m.targets[0] = {};
    m.targets[0].id = TargetFlight::kId;
    m.targets[0].latitude = -33.5;
    m.targets[0].longitude = 151.25;
    m.targets[0].position[0] = 30;
    for (const int i : {0, 3}) m.targets[0].position_covariance[i] = m.targets[0].velocity_covariance[i] = 2;
    return m;
  }
  template <typename Message>
  std::vector<Message> pass(int passes) {
    std::vector<Message> messages;
    for (int i = 0; i < passes; ++i) {
      publish();
      node_->processNext();
    }
    while (const auto frame = station_.parser.next()) {
      if (frame->id == Message::kId) messages.push_back(frame->message<Message>());
    }
    return messages;
  }
  process_health_t health() { return node_->health().nextMessage(); }

  std::unique_ptr<Bus> bus_ = makeLcmBus("memq://");
  Station station_;
  std::unique_ptr<GroundLinkNode> node_;
};

TEST_F(GroundLinkNodeTest, SendsBoxesAndWherePlacesAreKnownThose) {
  EXPECT_TRUE(pass<mavlink::CameraTrackingGeoStatus>(50).empty());
  bus_->publish("TARGETS", targets(0));
  EXPECT_TRUE(pass<mavlink::CameraTrackingGeoStatus>(50).empty()) << "metres from the take-off are no place";
  bus_->publish("TARGETS", targets(1));
  const auto places = pass<mavlink::CameraTrackingGeoStatus>(50);
  ASSERT_FALSE(places.empty());
  EXPECT_EQ(places.back().lat, -335'000'000);
  EXPECT_EQ(places.back().lon, 1'512'500'000);
  EXPECT_FLOAT_EQ(places.back().dist, 50);
  EXPECT_FLOAT_EQ(places.back().h_acc, 2);
  EXPECT_TRUE(std::isnan(places.back().alt));
  EXPECT_TRUE(std::isnan(places.back().hdg)) << "who stands has no course";
  station_.now_ns += 3'000'000'000;
  EXPECT_TRUE(pass<mavlink::CameraTrackingGeoStatus>(50).empty()) << "places that are no longer told";
  const auto boxes = pass<mavlink::CameraTrackingImageStatus>(50);
  ASSERT_GE(boxes.size(), 5U);
  EXPECT_NEAR(boxes[0].rec_bottom_x - boxes[0].rec_top_x, 12.0 / 640, 1e-6);
}

TEST_F(GroundLinkNodeTest, SaysWhatIsMissing) {
  node_->processNext();
  EXPECT_THAT(health().message, HasSubstr("no DETECTIONS has come"));
  publish();
  node_->processNext();
  EXPECT_EQ(health().state, process_health_t::GOOD);
  station_.is_open = false;
  station_.fault = "/dev/ttyUSB0: No such file or directory";
  node_->processNext();
  EXPECT_EQ(health().message, station_.fault);
}

TEST_F(GroundLinkNodeTest, SaysWhoIsPicked) {
  pass<mavlink::Heartbeat>(5);
  const detection_t box = TargetFlight{}.detections(0, 1, 0).detections[0];
  mavlink::Encoder station(255, 190);
  const auto x = static_cast<float>((box.x + 6) / 640.0), y = static_cast<float>((box.y + 8) / 480.0);
  station_.to_send.push_back(
      station.encode(mavlink::CommandLong{{x, y, 0}, mavlink::camera_command::kTrackPoint, 1, 100, 0}));
  pass<mavlink::Heartbeat>(2);
  EXPECT_EQ(health().message, "object 5 is picked");
}

TEST(GroundLinkNode, NeedsALink) {
  const auto bus = makeLcmBus("memq://");
  EXPECT_THROW(GroundLinkNode(*bus, TargetFlight::configuration()), UserError);
}

}  // namespace
}  // namespace redbee::test
