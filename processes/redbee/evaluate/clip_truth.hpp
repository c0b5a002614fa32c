// Ground truth of a clip.
//
//   mask/        see TruthMasks. Or labels/mask/, groundtruth/ (CDnet), Annotations/, or the folder itself
//   id/          the object id of each visible pixel, with objects.csv beside it: timestamp [ns], frame,
//                object_id, kind, state, ... Only objects whose state is `moving` count
//   boxes.csv    instead of id/, for every frame of the recording: frame_index, frame_file, object_id, class,
//                state, x, y, w, h [px]
//   gt/gt.txt    MOT's boxes, instead of boxes.csv; or gt.txt
//   ignore.csv   beside boxes.csv, areas that are unknown: frame_index, x, y, w, h [px]
//   frames/      the images of the recording, if masks are named after them
//
// The name of a mask is the frame's time [ns]. It is a frame's number instead if numbers are padded with
// zeros or follow letters, and the name of one of the images in frames/ if there is such a folder. Numbers
// count from 0; from 1 if they are named as CDnet's, or if the highest is the number of frames and there is
// no 0. Without id/ and boxes.csv, each connected region of a mask is an object.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <vector>

#include "processes/redbee/evaluate/truth_boxes.hpp"
#include "processes/redbee/evaluate/truth_masks.hpp"
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
    cv::Mat1b mask;  ///< empty if only objects are known
    ObjectTruth objects;
  };

  /// Throws InputError if the folder holds no ground truth or a table cannot be read.
  explicit ClipTruth(const std::filesystem::path& folder);
  /// The truth that nothing moves in any frame.
  static ClipTruth nothingMoves() { return ClipTruth(); }
  /// True if the folder holds masks.
  static bool isIn(const std::filesystem::path& folder);

  /// The labelled ones among the recording's frames, in order. `utimes`: of all frames of the recording [us],
  /// rising; labels by time are matched exactly, those by number by position. Labels without a frame of the
  /// same time are kept, so that frames lost by the run count. Throws InputError for a number beyond the last
  /// frame.
  std::vector<Frame> frames(const std::vector<int64_t>& utimes) const;
  /// Throws InputError if an image cannot be read or has another size.
  Labels read(const Frame& frame, cv::Size size) const;

 private:
  ClipTruth() = default;
  void findMasks(const std::filesystem::path& folder);
  void readObjectStates();
  ObjectTruth objectsFromIdentities(const Frame& frame, const cv::Mat1b& mask) const;
  ObjectTruth objectsFromBoxes(const Frame& frame, cv::Size size) const;

  bool by_number_ = false;
  bool from_one_ = false;  ///< for certain, by the names
  bool nothing_moves_ = true;
  bool has_identities_ = false;
  bool has_boxes_ = false;
  std::filesystem::path folder_;
  TruthMasks coding_;
  std::map<int64_t, std::filesystem::path> masks_;  ///< by time [us] or by number
  TruthBoxes objects_by_utime_;                     ///< objects.csv
  TruthBoxes boxes_;                                ///< boxes.csv, by number
  TruthBoxes ignored_;                              ///< ignore.csv, by number
};

}  // namespace redbee
