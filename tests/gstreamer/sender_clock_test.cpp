// Times that a network camera states of its images: attached to a buffer, and over RTP with RTCP's reports
// from a sender on the loopback whose packets are held up on their way.
#include "processes/camera/gstreamer/sender_clock.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <deque>
#include <iostream>
#include <mutex>
#include <random>
#include <vector>

#include "processes/camera/gstreamer/gstreamer_source.hpp"
#include "redbee/node/host_clock.hpp"

namespace redbee::test {
namespace {

using testing::HasSubstr;

constexpr int64_t kMillisecond_ns = 1'000'000;
constexpr int64_t kNtpToUnix_ns = 2'208'988'800'000'000'000;

int64_t now(clockid_t id) {
  timespec time{};
  clock_gettime(id, &time);
  return int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

struct Stated {
  std::optional<int64_t> time_ns;
  std::string fault;
};

/// What is made of an image that arrives now and states this time; nullptr: none.
Stated stated(const char* caps, int64_t time_ns, bool is_asked_for = true) {
  gst_init(nullptr, nullptr);
  const std::string property = is_asked_for ? " add-reference-timestamp-meta=true" : "";
  const GstPointer<GstElement> pipeline(GST_ELEMENT(
      gst_object_ref_sink(gst_parse_launch(("rtpbin" + property + " fakesink").c_str(), nullptr))));
  SenderClock clock(GST_BIN(pipeline.get()));
  GstBuffer* image = gst_buffer_new();
  if (caps != nullptr) {
    GstCaps* reference = gst_caps_from_string(caps);
    gst_buffer_add_reference_timestamp_meta(image, reference, static_cast<GstClockTime>(time_ns),
                                            GST_CLOCK_TIME_NONE);
    gst_caps_unref(reference);
  }
  const auto time = clock.hostTimeOf(image, hostNanoseconds());
  gst_buffer_unref(image);
  return {time, clock.fault()};
}

TEST(SenderClock, StatedTimesAreThoseOfOurClock) {
  const struct {
    const char* caps;
    clockid_t clock;
    int64_t epoch_ns;
  } cases[] = {{"timestamp/x-ntp", CLOCK_REALTIME, kNtpToUnix_ns},
               {"timestamp/x-unix", CLOCK_REALTIME, 0},
               {"timestamp/x-ptp, version=(string)IEEE1588-2008, domain=(int)0", CLOCK_TAI, 0}};
  for (const auto& each : cases) {
    const int64_t taken_ns = hostNanoseconds() - 70 * kMillisecond_ns;
    const Stated said = stated(each.caps, now(each.clock) - 70 * kMillisecond_ns + each.epoch_ns);
    ASSERT_TRUE(said.time_ns) << each.caps << ": " << said.fault;
    EXPECT_NEAR(static_cast<double>(*said.time_ns - taken_ns), 0, 20 * kMillisecond_ns) << each.caps;
    EXPECT_EQ(said.fault, "");
  }
}

TEST(SenderClock, AClockThatIsNotOursIsNotBelieved) {
  const int64_t today_ns = now(CLOCK_REALTIME);
  for (const int64_t apart_ns :
       {int64_t{30'000'000'000}, int64_t{3'000'000'000}, int64_t{-2'000'000'000}, today_ns}) {
    const Stated said = stated("timestamp/x-unix", today_ns - apart_ns);
    EXPECT_FALSE(said.time_ns) << apart_ns;
    EXPECT_THAT(said.fault, HasSubstr("time of day is not ours")) << apart_ns;
  }
}

TEST(SenderClock, ImagesWithoutATimeAreAFaultWhereTheyShouldHaveOne) {
  EXPECT_FALSE(stated(nullptr, 0).time_ns);
  EXPECT_THAT(stated(nullptr, 0).fault, HasSubstr("does not say when"));
  EXPECT_THAT(stated("timestamp/x-of-my-own", now(CLOCK_REALTIME)).fault, HasSubstr("does not say when"));
  EXPECT_EQ(stated(nullptr, 0, false).fault, "") << "as of every camera at this computer";
}

/// A port of the loopback that was free a moment ago, and the next one.
int freePorts() {
  for (;;) {
    const int first = socket(AF_INET, SOCK_DGRAM, 0), second = socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address;
    auto* any = reinterpret_cast<sockaddr*>(&address);
    const bool is_bound = bind(first, any, length) == 0 && getsockname(first, any, &length) == 0;
    const int port = ntohs(address.sin_port);
    address.sin_port = htons(static_cast<uint16_t>(port + 1));
    const bool is_next_free = is_bound && port < 65535 && bind(second, any, length) == 0;
    close(first);
    close(second);
    if (is_next_free) return port;
  }
}

/// A camera with RTCP: 10 images a second, each held up by 20 to 80 ms on its way.
class RtpSender {
 public:
  explicit RtpSender(int port) {
    const std::string to = " ! udpsink host=127.0.0.1 sync=false async=false port=";
    pipeline_.reset(GST_ELEMENT(gst_object_ref_sink(
        gst_parse_launch(("rtpbin name=b ntp-time-source=ntp videotestsrc name=camera is-live=true ! "
                          "video/x-raw,format=I420,width=64,height=48,framerate=10/1 ! jpegenc ! rtpjpegpay "
                          "! b.send_rtp_sink_0 "
                          "b.send_rtp_src_0 ! queue ! identity name=way" +
                          to + std::to_string(port) + " b.send_rtcp_src_0" + to + std::to_string(port + 1))
                             .c_str(),
                         nullptr))));
    probe("camera", &RtpSender::taken);
    probe("way", &RtpSender::holdUp);
    gst_element_set_state(pipeline_.get(), GST_STATE_PLAYING);
  }
  ~RtpSender() { gst_element_set_state(pipeline_.get(), GST_STATE_NULL); }
  RtpSender(const RtpSender&) = delete;
  RtpSender& operator=(const RtpSender&) = delete;

  /// From a time [us] to the nearest at which an image was taken.
  int64_t toNearest(int64_t utime) {
    const std::lock_guard lock(mutex_);
    int64_t nearest = 1'000'000'000;
    for (const int64_t taken : taken_us_) nearest = std::min(nearest, std::abs(taken - utime));
    return nearest;
  }

 private:
  using Handler = void (RtpSender::*)(GstBuffer*);
  template <typename Function>
  void probe(const char* element, Function handler) {
    const GstPointer<GstElement> of(gst_bin_get_by_name(GST_BIN(pipeline_.get()), element));
    const GstPointer<GstPad> pad(gst_element_get_static_pad(of.get(), "src"));
    probes_.push_back({this, handler});
    gst_pad_add_probe(
        pad.get(), GST_PAD_PROBE_TYPE_BUFFER,
        [](GstPad*, GstPadProbeInfo* info, gpointer data) {
          const auto* to = static_cast<const Probe*>(data);
          (to->sender->*to->handler)(GST_PAD_PROBE_INFO_BUFFER(info));
          return GST_PAD_PROBE_OK;
        },
        &probes_.back(), nullptr);
  }
  void taken(GstBuffer* image) {
    const std::lock_guard lock(mutex_);
    taken_us_.push_back(
        static_cast<int64_t>(gst_element_get_base_time(pipeline_.get()) + GST_BUFFER_PTS(image)) / 1000);
  }
  void holdUp(GstBuffer*) { g_usleep(std::uniform_int_distribution<gulong>(20'000, 80'000)(random_)); }

  struct Probe {
    RtpSender* sender;
    Handler handler;
  };
  std::deque<Probe> probes_;
  std::mt19937 random_{7};
  std::mutex mutex_;
  std::vector<int64_t> taken_us_;
  GstPointer<GstElement> pipeline_;
};

/// A network camera's pipeline with decoder and conversion, which have to hand on the times.
std::string receiver(int port, const std::string& properties) {
  return "rtpbin name=b latency=200 " + properties +
         " udpsrc address=127.0.0.1 port=" + std::to_string(port) +
         " caps=\"application/x-rtp,media=video,encoding-name=JPEG,clock-rate=90000,payload=26\" ! "
         "b.recv_rtp_sink_0 udpsrc address=127.0.0.1 port=" +
         std::to_string(port + 1) +
         " ! b.recv_rtcp_sink_0 b. ! rtpjpegdepay ! jpegdec ! videoconvert ! video/x-raw,format=GRAY8 ! "
         "appsink";
}

TEST(SenderClock, ImagesOverRtpHaveTheTimeAtWhichTheyWereTaken) {
  constexpr int kImages = 15, kMostWaits = 1500;
  const int port = freePorts();
  GstreamerSource source(receiver(port, "add-reference-timestamp-meta=true"));
  ASSERT_EQ(source.open(), "");
  RtpSender sender(port);
  int stated = 0, exact = 0;
  int64_t worst_us = 0, worst_before_us = 0;
  for (int i = 0; i < kMostWaits && stated < kImages && source.isOpen(); ++i) {
    const auto image = source.next(std::chrono::milliseconds(20));
    if (!image) continue;
    const int64_t off_us = sender.toNearest(image->utime);
    if (!source.timeFault().empty()) {
      EXPECT_THAT(source.timeFault(), HasSubstr("does not say when"));
      worst_before_us = std::max(worst_before_us, off_us);
      continue;
    }
    ++stated;
    exact += off_us < 3000 ? 1 : 0;
    worst_us = std::max(worst_us, off_us);
  }
  std::cout << exact << " of " << stated << " images within 3 ms of when they were taken, the worst off by "
            << worst_us << " us; before the first report by up to " << worst_before_us << " us\n";
  ASSERT_EQ(stated, kImages) << "no report came";
  EXPECT_EQ(exact, kImages);
  EXPECT_GT(worst_before_us, 10'000) << "there was something to correct";
}

}  // namespace
}  // namespace redbee::test
