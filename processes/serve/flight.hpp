// A recorded flight, frame by frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "processes/serve/flight_map.hpp"
#include "processes/serve/frame_view.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/results/run_folder.hpp"

namespace redbee {

/// The index of a log, or of the parts of a split one, read once; images and masks stay on the disk. Where
/// the log has no detections, those of a run over it are shown (`redbee detect`, `collect`).
class Flight {
 public:
  /// `runs`: folders with results, of which the newest that belongs to this flight is taken. Throws
  /// InputError if a part is no log, or if there is no image.
  Flight(const Configuration& configuration, std::vector<std::filesystem::path> parts,
         const std::vector<std::filesystem::path>& runs);

  size_t frames() const { return frames_.size(); }
  int64_t utime(size_t frame) const { return frames_[frame].utime; }
  /// Folder of the results that are shown; empty: the log's own, or none.
  const std::filesystem::path& run() const { return run_; }
  /// What is missing, in words; empty: nothing.
  const std::string& note() const { return note_; }

  /// Precondition: frame < frames(). Throws InputError if the disk no longer gives it.
  FrameView view(size_t frame) const;

 private:
  struct Place {
    size_t part = 0;
    int64_t offset = 0;
    size_t size = 0;  ///< bytes; 0: none
  };
  struct Frame {
    int64_t utime = 0;
    Place image;
    Place mask;
    std::optional<detections_t> detections;
    std::string source;
    int64_t from = 0;  ///< us, the frame that `H` starts from; 0: there is none
    Eigen::Matrix3d H;
  };

  struct Contents;

  void readPart(size_t part);
  void read(const std::string& channel, const std::vector<uint8_t>& data, const Place& place,
            Contents& contents);
  void takeStep(fused_homography_t message);
  std::vector<Trail> trailsAt(size_t index) const;
  void takeRun(const std::filesystem::path& folder);
  bool belongs(const std::filesystem::path& folder) const;
  const Frame* at(int64_t utime) const;
  Frame* at(int64_t utime) { return const_cast<Frame*>(std::as_const(*this).at(utime)); }
  std::vector<uint8_t> bytesAt(const Place& place) const;
  std::vector<uint8_t> maskOf(const Frame& frame) const;

  Configuration configuration_;
  Camera camera_;
  std::vector<std::filesystem::path> parts_;
  std::vector<Frame> frames_;  ///< by time
  FlightMap map_;
  std::filesystem::path run_;
  std::string note_;
};

}  // namespace redbee
