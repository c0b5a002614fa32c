// What is known to move in a clip: masks, identities and boxes from a truth folder.
//
//   mask/       255 moves, 0 does not, other values are not known. Or labels/mask/, or the folder itself
//   id/         the identity of each visible pixel, with objects.csv beside: timestamp [ns], frame,
//   object_id, kind,
//               state, ... Only objects whose state is `moving` count
//   boxes.csv   frame_index, frame_file, object_id, class, state, x, y, w, h [px]: objects by their boxes in
//   place of
//               id/, every frame of the recording labelled; ignore.csv: frame_index, x, y, w, h: areas not
//               known
//   frames/     the images of the recording, where masks have their names
//
// A mask's name is the frame's time [ns]. It is a frame's number (from 0) instead where numbers are padded
// with zeros or follow letters, and the name of one of the images in frames/ where there is such a folder.
// Without id/ and boxes.csv, each connected region of a mask is an object.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <vector>

#include "redbee/evaluation/object_measures.hpp"

namespace redbee {

class ClipTruth {
 public:
  struct Frame {
    int64_t utime = 0;           ///< us
    int64_t index = 0;           ///< of the recording, from 0
    std::filesystem::path mask;  ///< empty: only objects are known
  };
  struct Labels {
    cv::Mat mask;  ///< CV_8U; empty where only objects are known
    ObjectTruth objects;
  };

  /// Throws InputError where the folder holds no truth or a table cannot be read.
  explicit ClipTruth(const std::filesystem::path& folder);
  /// Nothing moves in any frame.
  static ClipTruth nothingMoves() { return ClipTruth(); }
  /// True where the folder holds masks.
  static bool isIn(const std::filesystem::path& folder);

  /// The labelled ones among the recording's frames, in order. `utimes`: of all frames of the recording [us],
  /// rising; labels by time are matched to the microsecond, those by number by position. Labels whose time
  /// none of the frames has are kept (a frame that the run has lost is still to be answered for); a number
  /// beyond the last frame is an InputError.
  std::vector<Frame> frames(const std::vector<int64_t>& utimes) const;
  /// Throws InputError where a image cannot be read or has not `size`.
  Labels read(const Frame& frame, cv::Size size) const;

 private:
  using Boxes = std::multimap<int64_t, TruthObject>;
  ClipTruth() = default;
  void findMasks(const std::filesystem::path& folder);
  void readObjectStates();
  ObjectTruth objectsFromIdentities(const Frame& frame, const cv::Mat& mask) const;
  ObjectTruth objectsFromBoxes(const Frame& frame, cv::Size size) const;

  bool by_number_ = false;
  bool nothing_moves_ = true;
  bool has_identities_ = false;
  bool has_boxes_ = false;
  std::filesystem::path folder_;
  std::map<int64_t, std::filesystem::path> masks_;  ///< by time [us] or by number
  Boxes objects_by_utime_;                          ///< objects.csv
  Boxes boxes_;                                     ///< boxes.csv, by number
  Boxes ignored_;                                   ///< ignore.csv, by number
};

}  // namespace redbee
