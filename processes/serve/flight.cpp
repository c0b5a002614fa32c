#include "processes/serve/flight.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <utility>

#include "processes/conversions.hpp"
#include "processes/detection_messages.hpp"
#include "redbee/bus/codec.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/log.hpp"
#include "redbee/fusion/fused_homography.hpp"
#include "redbee/node/message_check.hpp"

namespace redbee {
namespace {

/// The utime that every message of ours begins with, behind the hash; 0 for fewer bytes.
int64_t utimeOf(const std::vector<uint8_t>& data) {
  uint64_t utime = 0;
  if (data.size() < 16) return 0;
  for (size_t i = 8; i < 16; ++i) utime = utime << 8 | data[i];
  return static_cast<int64_t>(utime);
}

}  // namespace

Flight::Flight(const Configuration& configuration, std::vector<std::filesystem::path> parts,
               const std::vector<std::filesystem::path>& runs)
    : configuration_(configuration),
      camera_(configuration.camera),
      parts_(std::move(parts)),
      map_(configuration) {
  for (size_t part = 0; part < parts_.size(); ++part) readPart(part);
  map_.finish();
  if (frames_.empty()) {
    throw InputError(
        parts_.empty() ? std::filesystem::path("flight") : parts_.front(),
        "holds no image on " + configuration.channels.camera + ", the vehicle file's channel of the camera");
  }
  const bool has_detections = std::any_of(frames_.begin(), frames_.end(),
                                          [](const Frame& frame) { return frame.detections.has_value(); });
  if (has_detections) return;
  const auto run =
      std::find_if(runs.begin(), runs.end(), [this](const auto& folder) { return belongs(folder); });
  if (run != runs.end()) {
    takeRun(*run);
    return;
  }
  note_ = "the flight has no " + configuration.channels.detections +
          ", and no run over it is in the folders: redbee detect makes one";
}

const Flight::Frame* Flight::at(int64_t utime) const {
  const auto frame = std::lower_bound(frames_.begin(), frames_.end(), utime,
                                      [](const Frame& f, int64_t time) { return f.utime < time; });
  return frame != frames_.end() && frame->utime == utime ? &*frame : nullptr;
}

/// What stands about a part's frames, which may come before the frame itself.
struct Flight::Contents {
  std::vector<std::pair<int64_t, Place>> masks;
  std::vector<detections_t> detections;
  std::vector<fused_homography_t> steps;
};

void Flight::readPart(size_t part) {
  LogReader log(parts_[part]);
  Contents contents;
  while (auto event = log.next()) {
    const Place place{part, log.position() - static_cast<int64_t>(event->data.size()), event->data.size()};
    read(event->channel, event->data, place, contents);
  }
  for (const auto& [utime, place] : contents.masks) {
    if (Frame* frame = at(utime)) frame->mask = place;
  }
  for (detections_t& m : contents.detections) {
    if (Frame* frame = at(m.utime)) frame->detections = std::move(m);
  }
  for (fused_homography_t& m : contents.steps) takeStep(std::move(m));
}

void Flight::read(const std::string& channel, const std::vector<uint8_t>& data, const Place& place,
                  Contents& contents) {
  const Channels& channels = configuration_.channels;
  if (channel == channels.camera) {
    const int64_t utime = utimeOf(data);
    if (!isPlausibleTime(CameraTime(fromUtime(utime)))) return;
    if (!frames_.empty() && utime <= frames_.back().utime) return;
    Frame& frame = frames_.emplace_back();
    frame.utime = utime;
    frame.image = place;
  } else if (channel == channels.foreground) {
    contents.masks.emplace_back(utimeOf(data), place);
  } else if (channel == channels.detections) {
    if (detections_t m; decodePlausible(data, m)) contents.detections.push_back(std::move(m));
  } else if (channel == channels.fused_homography) {
    fused_homography_t m;
    if (!decodePlausible(data, m)) return;
    m.tracks = {};
    contents.steps.push_back(std::move(m));
  } else if (channel == channels.pose) {
    if (pose_t m; decodePlausible(data, m)) map_.add(m);
  } else if (channel == channels.targets) {
    if (targets_t m; decodePlausible(data, m)) map_.add(std::move(m));
  }
}

void Flight::takeStep(fused_homography_t message) {
  Frame* frame = at(message.utime);
  if (frame == nullptr) return;
  frame->source = toString(static_cast<FusionSource>(message.source));
  if (message.source == fused_homography_t::NONE) return;
  frame->from = message.utime_previous;
  frame->H = matrix3(message.step.H);
  map_.add(std::move(message));
}

/// A run belongs to a flight if all frames that it has homographies of are the flight's.
bool Flight::belongs(const std::filesystem::path& folder) const {
  try {
    const auto rows = RunFolder(folder).homographies();
    return !rows.empty() && std::all_of(rows.begin(), rows.end(),
                                        [this](const auto& row) { return at(row.first) != nullptr; });
  } catch (const UserError&) {
    return false;
  }
}

void Flight::takeRun(const std::filesystem::path& folder) {
  run_ = folder;
  const RunFolder run(folder);
  int64_t previous = 0;
  for (const auto& [utime, row] : run.homographies()) {
    Frame& frame = *at(utime);
    frame.source = row.source;
    frame.detections.emplace();
    frame.detections->utime = utime;
    const bool has_mask = run.has(RunMap::kMask, utime);
    frame.detections->status = has_mask ? foreground_t::GOOD : foreground_t::LEARNING;
    if (row.ground && previous != 0) {
      frame.from = previous;
      frame.H = *row.ground;
    }
    previous = utime;
  }
  for (const auto& [utime, detection] : run.detections()) {
    Frame* frame = at(utime);
    if (frame == nullptr || !frame->detections) continue;
    frame->detections->detections.push_back(messageOf(detection));
    frame->detections->n = static_cast<int32_t>(frame->detections->detections.size());
  }
}

std::vector<uint8_t> Flight::bytesAt(const Place& place) const {
  std::vector<uint8_t> data(place.size);
  std::ifstream file(parts_[place.part], std::ios::binary);
  file.seekg(place.offset);
  if (!file.read(reinterpret_cast<char*>(data.data()), static_cast<std::streamsize>(data.size())))
    throw InputError(parts_[place.part], "cannot be read any more");
  return data;
}

std::vector<uint8_t> Flight::maskOf(const Frame& frame) const {
  if (!frame.detections || frame.detections->status != foreground_t::GOOD) return {};
  if (frame.mask.size > 0) {
    foreground_t message;
    if (decodePlausible(bytesAt(frame.mask), message)) return message.mask;
    return {};
  }
  if (run_.empty()) return {};
  std::ifstream file(run_ / "mask" / (nameOfFrame(frame.utime) + ".png"), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<Trail> Flight::trailsAt(size_t index) const {
  Trails trails(camera_);
  size_t first = index;
  while (first > 0 && frames_[first - 1].utime > frames_[index].utime - Trails::kLength_us) --first;
  for (size_t k = first; k <= index; ++k) {
    const Frame& frame = frames_[k];
    if (frame.from != 0) trails.addStep(frame.from, frame.utime, frame.H);
    if (frame.detections) trails.addDetections(*frame.detections);
  }
  return trails.trails();
}

FrameView Flight::view(size_t index) const {
  const Frame& frame = frames_[index];
  FrameView view;
  view.utime = frame.utime;
  image_t image;
  if (decodePlausible(bytesAt(frame.image), image)) {
    view.image = std::make_shared<const image_t>(std::move(image));
  } else {
    view.note = "the image is damaged";
  }
  view.mask = maskOf(frame);
  view.detections = frame.detections;
  view.source = frame.source;
  if (!view.detections && view.note.empty())
    view.note = note_.empty() ? "no DETECTIONS of this frame" : note_;
  view.trails = trailsAt(index);
  view.map = map_.at(frame.utime);
  return view;
}

}  // namespace redbee
