#include "processes/camera/gstreamer/sender_clock.hpp"

#include <ctime>
#include <initializer_list>

#include "redbee/node/host_clock.hpp"

namespace redbee {
namespace {

constexpr int64_t kSecond_ns = 1'000'000'000;
constexpr int64_t kNtpToUnix_ns = int64_t{2'208'988'800} * kSecond_ns;  // 1900 to 1970
// An image arrives after it was taken, by both clocks' difference less, and not as late as this.
constexpr int64_t kLatest_ns = 2 * kSecond_ns, kClocksDiffer_ns = kSecond_ns / 10;

struct StatedClock {
  const char* caps;
  clockid_t ours;
  int64_t epoch_ns;  // before ours
};
constexpr StatedClock kClocks[] = {{"timestamp/x-ntp", CLOCK_REALTIME, kNtpToUnix_ns},
                                   {"timestamp/x-unix", CLOCK_REALTIME, 0},
                                   {"timestamp/x-ptp", CLOCK_TAI, 0}};

const StatedClock* clockOf(const GstReferenceTimestampMeta& meta) {
  const GstStructure* structure = gst_caps_get_structure(meta.reference, 0);
  for (const StatedClock& clock : kClocks)
    if (gst_structure_has_name(structure, clock.caps) != FALSE) return &clock;
  return nullptr;
}

/// What this clock of the computer shows more than the one that we stamp with, which is never set.
int64_t aheadOfHost(clockid_t id) {
  timespec time{};
  const int64_t before_ns = hostNanoseconds();
  clock_gettime(id, &time);
  const int64_t after_ns = hostNanoseconds();
  return int64_t{time.tv_sec} * kSecond_ns + time.tv_nsec - before_ns - (after_ns - before_ns) / 2;
}

bool attachesTimes(GstElement* element) {
  constexpr const char* kProperty = "add-reference-timestamp-meta";
  gboolean is_on = FALSE;
  if (g_object_class_find_property(G_OBJECT_GET_CLASS(element), kProperty) != nullptr)
    g_object_get(element, kProperty, &is_on, nullptr);
  return is_on != FALSE;
}

}  // namespace

SenderClock::SenderClock(GstBin* pipeline) : is_asked_for_(false) {
  GstIterator* elements = gst_bin_iterate_recurse(pipeline);
  GValue item = G_VALUE_INIT;
  while (gst_iterator_next(elements, &item) == GST_ITERATOR_OK) {
    is_asked_for_ = is_asked_for_ || attachesTimes(GST_ELEMENT(g_value_get_object(&item)));
    g_value_reset(&item);
  }
  g_value_unset(&item);
  gst_iterator_free(elements);
}

std::optional<int64_t> SenderClock::hostTimeOf(GstBuffer* image, int64_t arrived_ns) {
  const GstReferenceTimestampMeta* meta = gst_buffer_get_reference_timestamp_meta(image, nullptr);
  const StatedClock* clock = meta != nullptr ? clockOf(*meta) : nullptr;
  fault_.clear();
  if (clock == nullptr) {
    if (is_asked_for_)
      fault_ =
          "the sender does not say when it took the images (no RTCP report yet?): their times are those of "
          "their arrival";
    return std::nullopt;
  }
  const auto since_ns = static_cast<int64_t>(meta->timestamp) - clock->epoch_ns - aheadOfHost(clock->ours);
  if (since_ns < arrived_ns - kLatest_ns || since_ns > arrived_ns + kClocksDiffer_ns) {
    fault_ =
        "the sender's time of day is not ours (NTP, PTP on both?): the images' times are those of their "
        "arrival";
    return std::nullopt;
  }
  return since_ns;
}

}  // namespace redbee
