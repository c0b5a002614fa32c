#include "processes/camera/gstreamer/gstreamer_source.hpp"

#include <cstdlib>
#include <utility>

#include "processes/camera/gstreamer/pipeline_fault.hpp"
#include "processes/camera/gstreamer/sample_image.hpp"
#include "processes/camera/v4l2_exposure.hpp"
#include "redbee/files/user_error.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/node/host_clock.hpp"

namespace redbee {
namespace {

constexpr const char* kCaps = "image/jpeg; video/x-raw,format=(string){GRAY8,RGB,BGR}";
constexpr guint kMostQueued = 4;   // images; a process that falls behind by more drops the oldest
constexpr int kFirstReadings = 5;  // that ClockEstimator wants
constexpr int64_t kLatest_ns =
    10'000'000'000;  // an image's time differs from its arrival by less, or is of another clock

struct FreeError {
  void operator()(GError* error) const { g_error_free(error); }
};
struct UnrefSample {
  void operator()(GstSample* sample) const { gst_sample_unref(sample); }
};
struct UnrefMessage {
  void operator()(GstMessage* message) const { gst_message_unref(message); }
};
struct UnrefCaps {
  void operator()(GstCaps* caps) const { gst_caps_unref(caps); }
};

/// The only appsink; nullptr if there is none, or more than one.
GstElement* onlyAppSinkOf(GstBin* bin) {
  GstElement* found = nullptr;
  int count = 0;
  GstIterator* sinks = gst_bin_iterate_sinks(bin);
  GValue item = G_VALUE_INIT;
  while (gst_iterator_next(sinks, &item) == GST_ITERATOR_OK) {
    auto* element = GST_ELEMENT(g_value_get_object(&item));
    if (GST_IS_APP_SINK(element) && count++ == 0) found = GST_ELEMENT(gst_object_ref(element));
    g_value_reset(&item);
  }
  g_value_unset(&item);
  gst_iterator_free(sinks);
  if (count > 1) gst_object_unref(std::exchange(found, nullptr));
  return found;
}

/// The first element of that factory; nullptr if there is none.
GstElement* firstOf(GstBin* bin, const char* factory_name) {
  GstElement* found = nullptr;
  GstIterator* elements = gst_bin_iterate_recurse(bin);
  GValue item = G_VALUE_INIT;
  while (found == nullptr && gst_iterator_next(elements, &item) == GST_ITERATOR_OK) {
    auto* element = GST_ELEMENT(g_value_get_object(&item));
    GstElementFactory* factory = gst_element_get_factory(element);
    const bool is_it = factory != nullptr && std::string(GST_OBJECT_NAME(factory)) == factory_name;
    if (is_it) found = GST_ELEMENT(gst_object_ref(element));
    g_value_reset(&item);
  }
  g_value_unset(&item);
  gst_iterator_free(elements);
  return found;
}

}  // namespace

GstreamerSource::GstreamerSource(std::string pipeline) : description_(std::move(pipeline)) {
  // It greets on the terminal each time that a pipeline is made.
  setenv("LIBCAMERA_LOG_LEVELS", "*:ERROR", 0);
  gst_init(nullptr, nullptr);
  const std::string fault = build();
  GstreamerSource::close();
  if (!fault.empty()) throw UserError("capture.pipeline: " + fault);
}

GstreamerSource::~GstreamerSource() { GstreamerSource::close(); }

std::string GstreamerSource::build() {
  GError* raw_error = nullptr;
  GstElement* made = gst_parse_launch(description_.c_str(), &raw_error);
  const std::unique_ptr<GError, FreeError> error(raw_error);
  if (made != nullptr) pipeline_.reset(GST_ELEMENT(gst_object_ref_sink(made)));
  if (error) return faultOf(*error);
  GstElement* sink = GST_IS_BIN(made) ? onlyAppSinkOf(GST_BIN(made)) : nullptr;
  if (sink == nullptr)
    return "must end in one appsink: ... ! videoconvert ! video/x-raw,format=GRAY8 ! appsink";
  sink_.reset(sink);
  v4l2_source_.reset(firstOf(GST_BIN(made), "v4l2src"));
  sender_clock_.emplace(GST_BIN(made));
  const std::unique_ptr<GstCaps, UnrefCaps> caps(gst_caps_from_string(kCaps));
  g_object_set(sink, "caps", caps.get(), "max-buffers", kMostQueued, "drop", TRUE, nullptr);
  return "";
}

std::string GstreamerSource::open() {
  fault_.clear();
  clock_.restart();
  if (fault_ = build(); !fault_.empty()) {
    close();
    return fault_;
  }
  const GstStateChangeReturn change = gst_element_set_state(pipeline_.get(), GST_STATE_PLAYING);
  // A live source need not be held back until an image's time has come: it has when the image was taken.
  if (change == GST_STATE_CHANGE_NO_PREROLL) g_object_set(sink_.get(), "sync", FALSE, nullptr);
  if (change == GST_STATE_CHANGE_FAILURE) {
    if (!hasStopped()) fault_ = "the pipeline cannot be started";
    close();
  }
  return fault_;
}

void GstreamerSource::close() {
  if (pipeline_) gst_element_set_state(pipeline_.get(), GST_STATE_NULL);
  sink_.reset();
  v4l2_source_.reset();
  exposure_s_.reset();
  images_ = 0;  // the next pipeline's exposure is asked for at its first
  pipeline_.reset();
}

bool GstreamerSource::hasStopped() {
  const GstPointer<GstBus> bus(gst_element_get_bus(pipeline_.get()));
  const auto kinds = static_cast<GstMessageType>(GST_MESSAGE_ERROR | GST_MESSAGE_EOS);
  const std::unique_ptr<GstMessage, UnrefMessage> message(gst_bus_pop_filtered(bus.get(), kinds));
  if (!message) {
    // The message of the end comes later than the end, and not before the pipeline plays.
    if (gst_app_sink_is_eos(GST_APP_SINK(sink_.get())) == FALSE) return false;
    fault_ = "the pipeline has ended";
    return true;
  }
  if (GST_MESSAGE_TYPE(message.get()) == GST_MESSAGE_EOS) {
    fault_ = "the pipeline has ended";
    return true;
  }
  fault_ = faultOf(message.get());
  return true;
}

void GstreamerSource::readClocks() {
  const GstPointer<GstClock> theirs(gst_element_get_clock(pipeline_.get()));
  if (!theirs) return;
  for (int i = clock_.state() ? kFirstReadings - 1 : 0; i < kFirstReadings; ++i) {
    const int64_t before_ns = hostNanoseconds();
    const auto device_ns = static_cast<int64_t>(gst_clock_get_time(theirs.get()));
    const int64_t after_ns = hostNanoseconds();
    if (device_ns >= 0 && device_ns <= mavlink::TimesyncExchange::kMaxTime_ns)
      clock_.add({before_ns, device_ns, after_ns});
  }
}

/// A camera on USB answers in a millisecond or so, and changes its exposure over many images.
void GstreamerSource::readExposure() {
  constexpr int64_t kPeriod = 8;  // images
  if (!v4l2_source_ || images_++ % kPeriod != 0) return;
  gint device = -1;
  g_object_get(v4l2_source_.get(), "device-fd", &device, nullptr);
  exposure_s_ = v4l2Exposure(device);
}

int64_t GstreamerSource::hostTimeOf(GstSample* sample, int64_t arrived_ns) {
  GstBuffer* buffer = gst_sample_get_buffer(sample);
  if (const auto stated_ns = sender_clock_->hostTimeOf(buffer, arrived_ns)) return *stated_ns;
  const GstClockTime stamp = GST_BUFFER_PTS(buffer);
  if (GST_CLOCK_TIME_IS_VALID(stamp) == FALSE) return arrived_ns;
  const guint64 running = gst_segment_to_running_time(gst_sample_get_segment(sample), GST_FORMAT_TIME, stamp);
  if (GST_CLOCK_TIME_IS_VALID(running) == FALSE) return arrived_ns;
  const auto device_ns = static_cast<int64_t>(gst_element_get_base_time(pipeline_.get()) + running);
  const auto host_ns = clock_.toHost(device_ns);
  if (!host_ns || *host_ns < arrived_ns - kLatest_ns || *host_ns > arrived_ns + kLatest_ns) return arrived_ns;
  return *host_ns;
}

std::optional<image_t> GstreamerSource::next(std::chrono::milliseconds timeout) {
  const auto wait = static_cast<GstClockTime>(timeout.count()) * GST_MSECOND;
  const std::unique_ptr<GstSample, UnrefSample> sample(
      gst_app_sink_try_pull_sample(GST_APP_SINK(sink_.get()), wait));
  const int64_t arrived_ns = hostNanoseconds();
  std::optional<image_t> image;
  if (sample) {
    readClocks();
    readExposure();
    image = imageOf(sample.get());
    if (image) image->utime = fromNanoseconds(hostTimeOf(sample.get(), arrived_ns)).count();
  } else if (hasStopped()) {
    close();
  }
  return image;
}

}  // namespace redbee
