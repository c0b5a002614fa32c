// What the live mosaic has painted: the ground, the tracks of what moved on it, and why it is not the whole
// flight.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "processes/redbee/mosaic/frame_painter.hpp"
#include "processes/redbee/mosaic/track_drawing.hpp"
#include "processes/serve/frame_view.hpp"
#include "redbee/configuration/configuration.hpp"

namespace redbee {

/// A frame whose way to the map is known.
struct MosaicFrame {
  size_t mosaic = 0;     ///< which it belongs to
  size_t map = 0;        ///< of those that were laid in its course
  const char* why = "";  ///< the mosaic began; empty: somebody looked
  int64_t utime = 0;     ///< us
  Eigen::Matrix3d to_map;
  bool is_metric = false;
  detections_t detections;
  std::shared_ptr<const image_t> image;  ///< null: for the tracks alone
  std::vector<uint8_t> mask;
  Exposure exposure;
};

/// Bounded: the image, from which the newest frame pushes what is furthest away; the tracks. To be used by
/// one thread at a time, but for camera() and idealSize().
class MosaicPainting {
 public:
  static constexpr int kMost_px = 1280;       ///< of a side
  static constexpr size_t kMostTracks = 200;  ///< the newest
  static constexpr size_t kMostPoints = 500;  ///< of a track; of a longer one every second goes

  explicit MosaicPainting(const Configuration& configuration)
      : painter_(configuration.camera, configuration.own_parts) {}

  const Camera& camera() const { return painter_.camera(); }
  cv::Size idealSize() const { return painter_.idealSize(); }

  void add(const MosaicFrame& frame);
  void clear();

  /// A bundle of bundleOf() whose JSON has sequence, width, height, utime and start (us, of the newest and
  /// the first frame), units_per_px, unit ("m" or "px"), frames, tracks (id; points, and labels as x, y and
  /// text, on the image) and notes (why it is not the whole flight, in words). Null where its number is still
  /// `after`, or where there is nothing yet.
  std::shared_ptr<const std::string> newest(int64_t after);

 private:
  void paint(const MosaicFrame& frame);
  bool makeRoomFor(const MosaicFrame& frame);
  bool begin(const MosaicFrame& frame);
  void addTracks(const MosaicFrame& frame);
  void cutTracks();
  std::string encode() const;

  FramePainter painter_;
  std::optional<Mosaic> mosaic_;
  GroundTracks tracks_;
  size_t number_ = 0;
  size_t map_ = 0;
  const char* why_ = "";
  bool is_relaid_ = false;
  bool has_lost_flight_ = false;  ///< too much was refused
  bool is_metric_ = false;
  int64_t start_utime_ = 0;
  int64_t utime_ = 0;
  int64_t frames_ = 0;
  int refused_ = 0;  ///< in a row
  int64_t sequence_ = 0;
  std::shared_ptr<const std::string> bundle_;  ///< of `sequence_`; null: to be made
};

}  // namespace redbee
