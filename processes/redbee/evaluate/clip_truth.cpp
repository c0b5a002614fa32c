#include "processes/redbee/evaluate/clip_truth.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "redbee/files/csv.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/results/png_file.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

constexpr uint8_t kUnknown = 128;

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

std::vector<fs::path> pngsOf(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".png") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::optional<fs::path> baseOf(const fs::path& folder) {
  if (!pngsOf(folder / "labels" / "mask").empty()) return folder / "labels";
  if (!pngsOf(folder / "mask").empty() || !pngsOf(folder).empty()) return folder;
  return std::nullopt;
}

/// Positions of the recording's images by name; empty where they are not available.
std::map<std::string, int64_t> imageNumbers(const fs::path& folder) {
  std::vector<std::string> stems;
  if (fs::is_directory(folder)) {
    for (const auto& entry : fs::directory_iterator(folder)) stems.push_back(entry.path().stem().string());
  }
  std::sort(stems.begin(), stems.end());
  std::map<std::string, int64_t> numbers;
  for (const std::string& stem : stems) numbers.emplace(stem, static_cast<int64_t>(numbers.size()));
  return numbers;
}

/// The number that a name ends with.
int64_t numberIn(const fs::path& file) {
  const std::string stem = file.stem().string();
  size_t first = stem.size();
  while (first > 0 && isDigit(stem[first - 1])) --first;
  const std::string digits = stem.substr(first);
  if (digits.empty() || digits.size() > 19)
    throw InputError(file, "its name does not end with a time or a frame number");
  return std::stoll(digits);
}

bool looksLikeFrameNumber(const fs::path& file) {
  const std::string stem = file.stem().string();
  return !isDigit(stem.front()) || (stem.size() > 1 && stem.front() == '0');
}

cv::Mat1b readLabels(const fs::path& file, cv::Size size) {
  cv::Mat1b labels = readGreyPng(file);
  if (labels.size() != size) {
    throw InputError(file, fmt::format("has {}x{} px, the run's maps have {}x{}", labels.cols, labels.rows,
                                       size.width, size.height));
  }
  return labels;
}

TruthObject boxAt(const CsvReader& csv, size_t x) {
  TruthObject object;
  object.box = {csv.number(x), csv.number(x + 1), csv.number(x + 2), csv.number(x + 3)};
  return object;
}

std::multimap<int64_t, TruthObject> readBoxes(const fs::path& file) {
  constexpr size_t kColumns = 9;
  std::multimap<int64_t, TruthObject> boxes;
  CsvReader csv(file);
  csv.next(kColumns);  // the names of the columns
  while (csv.next(kColumns)) {
    TruthObject object = boxAt(csv, 5);
    object.id = static_cast<int>(csv.integer(2));
    object.counts = csv.fields()[4] == "moving";
    boxes.emplace(csv.integer(0), object);
  }
  return boxes;
}

std::multimap<int64_t, TruthObject> readIgnored(const fs::path& file) {
  constexpr size_t kColumns = 5;
  std::multimap<int64_t, TruthObject> boxes;
  if (!fs::exists(file)) return boxes;
  CsvReader csv(file);
  csv.next(kColumns);  // the names of the columns
  while (csv.next(kColumns)) boxes.emplace(csv.integer(0), boxAt(csv, 1));
  return boxes;
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

bool ClipTruth::isIn(const fs::path& folder) { return baseOf(folder).has_value(); }

ClipTruth::ClipTruth(const fs::path& folder) : nothing_moves_(false) {
  const auto base = baseOf(folder);
  if (!base) throw InputError(folder, "holds no ground-truth masks");
  folder_ = *base;
  findMasks(pngsOf(folder_ / "mask").empty() ? folder_ : folder_ / "mask");
  has_boxes_ = fs::exists(folder_ / "boxes.csv");
  if (has_boxes_) {
    boxes_ = readBoxes(folder_ / "boxes.csv");
    ignored_ = readIgnored(folder_ / "ignore.csv");
  }
  has_identities_ = !has_boxes_ && fs::is_directory(folder_ / "id") && fs::exists(folder_ / "objects.csv");
  if (has_identities_) readObjectStates();
}

void ClipTruth::findMasks(const fs::path& folder) {
  const std::vector<fs::path> files = pngsOf(folder);
  const auto images = imageNumbers(folder_ / "frames");
  by_number_ = !images.empty() || std::any_of(files.begin(), files.end(), looksLikeFrameNumber);
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
  if (by_number_ && !masks_.empty() && masks_.rbegin()->first >= static_cast<int64_t>(utimes.size())) {
    throw InputError(masks_.rbegin()->second, "is of frame " + std::to_string(masks_.rbegin()->first) +
                                                  ", the recording has " + std::to_string(utimes.size()));
  }
  if (!by_number_ && !nothing_moves_) {
    for (const auto& [utime, mask] : masks_) {
      const auto at = std::lower_bound(utimes.begin(), utimes.end(), utime);
      labelled.push_back({utime, at - utimes.begin(), mask});
    }
    return labelled;
  }
  for (size_t i = 0; i < utimes.size(); ++i) {
    const auto mask = masks_.find(static_cast<int64_t>(i));
    const bool known = nothing_moves_ || has_boxes_ || mask != masks_.end();
    if (known) {
      labelled.push_back(
          {utimes[i], static_cast<int64_t>(i), mask == masks_.end() ? fs::path() : mask->second});
    }
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
  if (!frame.mask.empty()) labels.mask = readLabels(frame.mask, size);
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
  readLabels(folder_ / "id" / frame.mask.filename(), mask.size()).convertTo(truth.ids, CV_32S);
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
