#include "processes/redbee/evaluate/clip_truth.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "redbee/files/csv.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/natural_order.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/results/png_file.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

constexpr uint8_t kUnknown = 128;

/// Where data sets keep their masks.
const char* const kMaskFolders[] = {"labels/mask", "mask", "groundtruth", "Annotations", "."};

std::optional<fs::path> maskFolderIn(const fs::path& folder) {
  for (const char* name : kMaskFolders) {
    const fs::path masks = std::string(name) == "." ? folder : folder / name;
    if (!masksIn(masks).empty()) return masks;
  }
  return std::nullopt;
}

/// Positions of the recording's images by name; empty if they are not available.
std::map<std::string, int64_t> imageNumbers(const fs::path& folder) {
  std::vector<std::string> stems;
  if (fs::is_directory(folder)) {
    for (const auto& entry : fs::directory_iterator(folder)) stems.push_back(entry.path().stem().string());
  }
  std::sort(stems.begin(), stems.end(), isNaturallyBefore);
  std::map<std::string, int64_t> numbers;
  for (const std::string& stem : stems) numbers.emplace(stem, static_cast<int64_t>(numbers.size()));
  return numbers;
}

cv::Mat1b ofSize(const cv::Mat1b& labels, const fs::path& file, cv::Size size) {
  if (labels.size() != size) {
    throw InputError(file, fmt::format("has {}x{} px, the run's maps have {}x{}", labels.cols, labels.rows,
                                       size.width, size.height));
  }
  return labels;
}

cv::Rect pixelsOf(const cv::Rect2d& box) {
  const cv::Point corner(cvRound(box.x), cvRound(box.y));
  return {corner, cv::Point(cvRound(box.br().x), cvRound(box.br().y))};
}

template <typename Work>
void forEachIn(const std::multimap<int64_t, TruthObject>& boxes, int64_t key, const Work& work) {
  const auto [begin, end] = boxes.equal_range(key);
  for (auto it = begin; it != end; ++it) work(it->second);
}

}  // namespace

bool ClipTruth::isIn(const fs::path& folder) {
  return maskFolderIn(folder).has_value() || motFileIn(folder).has_value();
}

ClipTruth::ClipTruth(const fs::path& folder) : nothing_moves_(false) {
  const auto masks = maskFolderIn(folder);
  const auto mot = motFileIn(folder);
  if (!masks && !mot) {
    throw InputError(folder,
                     "holds no ground-truth masks (looked for PNG or JPEG in ., mask, labels/mask, "
                     "groundtruth and Annotations, and for MOT's gt.txt)");
  }
  folder_ = masks && *masks == folder / "labels" / "mask" ? folder / "labels" : folder;
  if (masks) findMasks(*masks);
  has_boxes_ = mot.has_value() || fs::exists(folder_ / "boxes.csv");
  if (mot) {
    boxes_ = readMotBoxes(*mot);
  } else if (has_boxes_) {
    boxes_ = readBoxes(folder_ / "boxes.csv");
    ignored_ = readIgnoredBoxes(folder_ / "ignore.csv");
  }
  has_identities_ = !has_boxes_ && fs::is_directory(folder_ / "id") && fs::exists(folder_ / "objects.csv");
  if (has_identities_) readObjectStates();
}

void ClipTruth::findMasks(const fs::path& folder) {
  const std::vector<fs::path> files = masksIn(folder);
  coding_ = TruthMasks(files);
  const auto images = imageNumbers(folder_ / "frames");
  by_number_ = !images.empty() || std::any_of(files.begin(), files.end(), looksLikeFrameNumber);
  from_one_ = images.empty() && std::all_of(files.begin(), files.end(), countsFromOne);
  for (const fs::path& file : files) {
    if (images.empty()) {
      masks_[by_number_ ? numberIn(file) : fromNanoseconds(numberIn(file)).count()] = file;
      continue;
    }
    const auto image = images.find(file.stem().string());
    if (image == images.end()) throw InputError(file, "frames/ holds no image of this name");
    masks_[image->second] = file;
  }
}

void ClipTruth::readObjectStates() {
  CsvReader csv(folder_ / "objects.csv");
  while (csv.next(0)) {
    if (csv.fields().size() < 5) csv.fail("has fewer than 5 columns");
    TruthObject object;
    object.id = static_cast<int>(csv.integer(2));
    object.counts = csv.fields()[4] == "moving";
    objects_by_utime_.emplace(fromNanoseconds(csv.integer(0)).count(), object);
  }
}

std::vector<ClipTruth::Frame> ClipTruth::frames(const std::vector<int64_t>& utimes) const {
  std::vector<Frame> labelled;
  if (!by_number_ && !nothing_moves_ && !masks_.empty()) {
    for (const auto& [utime, mask] : masks_) {
      const auto at = std::lower_bound(utimes.begin(), utimes.end(), utime);
      labelled.push_back({utime, at - utimes.begin(), mask});
    }
    return labelled;
  }
  const auto count = static_cast<int64_t>(utimes.size());
  const int64_t last = masks_.empty() ? -1 : masks_.rbegin()->first;
  // A number as high as the recording has frames, and no 0: they are counted from 1.
  const int64_t first = from_one_ || (last == count && masks_.count(0) == 0) ? 1 : 0;
  if (last - first >= count) {
    throw InputError(masks_.rbegin()->second,
                     "is of frame " + std::to_string(last) + ", the recording has " + std::to_string(count));
  }
  for (int64_t i = 0; i < count; ++i) {
    const auto mask = masks_.find(i + first);
    const bool known = nothing_moves_ || has_boxes_ || mask != masks_.end();
    if (known)
      labelled.push_back(
          {utimes[static_cast<size_t>(i)], i, mask == masks_.end() ? fs::path() : mask->second});
  }
  return labelled;
}

ClipTruth::Labels ClipTruth::read(const Frame& frame, cv::Size size) const {
  Labels labels;
  if (nothing_moves_) {
    labels.mask = cv::Mat1b::zeros(size);
    labels.objects = objectsOfMask(labels.mask);
    return labels;
  }
  if (!frame.mask.empty()) labels.mask = ofSize(coding_.read(frame.mask), frame.mask, size);
  if (has_boxes_) {
    labels.objects = objectsFromBoxes(frame, size);
  } else if (has_identities_) {
    labels.objects = objectsFromIdentities(frame, labels.mask);
  } else {
    labels.objects = objectsOfMask(labels.mask);
  }
  return labels;
}

ObjectTruth ClipTruth::objectsFromIdentities(const Frame& frame, const cv::Mat1b& mask) const {
  ObjectTruth truth = objectsOfMask(mask);
  truth.objects.clear();
  truth.has_identities = true;
  const fs::path ids = folder_ / "id" / frame.mask.filename();
  ofSize(readGreyPng(ids), ids, mask.size()).convertTo(truth.ids, CV_32S);
  forEachIn(objects_by_utime_, frame.utime,
            [&](const TruthObject& object) { truth.objects.push_back(object); });
  return truth;
}

ObjectTruth ClipTruth::objectsFromBoxes(const Frame& frame, cv::Size size) const {
  ObjectTruth truth;
  truth.ignored = cv::Mat1b::zeros(size);
  const cv::Rect image({}, size);
  forEachIn(ignored_, frame.index,
            [&](const TruthObject& area) { truth.ignored(pixelsOf(area.box) & image) = kUnknown; });
  forEachIn(boxes_, frame.index, [&](const TruthObject& object) {
    truth.ignored(pixelsOf(object.box) & image) = 0;
    truth.objects.push_back(object);
  });
  return truth;
}

}  // namespace redbee
