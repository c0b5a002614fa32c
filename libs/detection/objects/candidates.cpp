#include "redbee/detection/objects/candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/detection/objects/object_trees.hpp"
#include "redbee/detection/objects/regions.hpp"
#include "redbee/imaging/connected_regions.hpp"

namespace redbee {
namespace {

constexpr std::array<int, 4> kLevels{51, 89, 128, 166};  // of the appearance difference, 0 to 255
// px^2 of the image. Nine of ten candidates of objects that the trees were trained on are smaller.
constexpr double kLeastArea_px2 = 24, kMostArea_px2 = 3500;
constexpr int kLeastForeground = 25;  // of 255, of the greatest P_FG of a candidate's pixels
constexpr double kDoubled = 0.4;      // fraction of the smaller of two boxes inside the other: one object
// What is a candidate in one frame is one in the next: what a track adds up is not independent.
constexpr double kCaution = -1;
constexpr double kLeastLogOdds = -3;
// Less sure ones yield to a component of P_FG: it may be of a kind that the trees do not know.
constexpr double kSureLogOdds = 1.5;

cv::Rect inImage(const cv::Rect& box, cv::Size map, cv::Size image) {
  const auto scaled = [&](const cv::Point& at) {
    return cv::Point(at.x * image.width / map.width, at.y * image.height / map.height);
  };
  return cv::Rect(scaled(box.tl()), scaled(box.br())) & cv::Rect({}, image);
}

bool areDoubled(const cv::Rect& a, const cv::Rect& b) {
  return (a & b).area() > kDoubled * std::min(a.area(), b.area());
}

bool areDoubled(const ForegroundComponents& found, const cv::Rect& box) {
  return std::any_of(found.components.begin(), found.components.end(),
                     [&](const Component& component) { return areDoubled(component.box, box); });
}

/// `pixels`: of the box; empty: all of them.
int greatestForeground(const ForegroundMaps& maps, const cv::Rect& box, const cv::Mat1b& pixels = {}) {
  int most = 0;
  for (int y = 0; y < box.height; ++y) {
    const uint8_t* const appearance = maps.appearance[box.y + y] + box.x;
    const uint8_t* const motion = maps.motion[box.y + y] + box.x;
    const uint8_t* const own = pixels.empty() ? nullptr : pixels[y];
    for (int x = 0; x < box.width; ++x) {
      if (own == nullptr || own[x] != 0) most = std::max(most, appearance[x] * motion[x] / 255);
    }
  }
  return most;
}

/// The part of the image that candidates lie in which may become components.
cv::Rect partOf(const std::vector<Candidate>& candidates, cv::Size maps, cv::Size image) {
  cv::Rect part;
  for (const Candidate& candidate : candidates) {
    if (candidate.log_odds + kCaution < kLeastLogOdds) break;
    part |= inImage(candidate.box, maps, image);
  }
  return part;
}

/// Components without pixels in common.
class ComponentSet {
 public:
  ComponentSet(const cv::Mat1b& probability, const cv::Rect& part) : probability_(probability) {
    found_.image = probability.size();
    found_.part = part;
    found_.labels = cv::Mat1w::zeros(part.size());
  }

  /// Whether one that claims its box covers the other, or is covered.
  bool isDoubled(const cv::Rect& box) const {
    return std::any_of(claimed_.begin(), claimed_.end(),
                       [&](const cv::Rect& claimed) { return areDoubled(claimed, box); });
  }
  void claim(const cv::Rect& box) { claimed_.push_back(box); }

  /// What is left of it, if that is most of it. `pixels`: of its box.
  bool add(Component component, const cv::Mat1b& pixels) {
    cv::Mat1w labels = found_.labels(component.box - found_.part.tl());
    const cv::Mat1b probability = probability_(component.box);
    int all = 0, free = 0;
    int64_t sum = 0;
    forEach(pixels, [&](int y, int x) {
      ++all;
      if (labels(y, x) != 0) return;
      ++free;
      sum += probability(y, x);
    });
    if (free == 0 || free < (1 - kDoubled) * all || found_.isFull()) return false;
    component.area_px = free;
    component.score = static_cast<double>(sum) / (255.0 * free);
    found_.components.push_back(component);
    const auto label = static_cast<uint16_t>(found_.components.size());
    forEach(pixels, [&](int y, int x) {
      if (labels(y, x) == 0) labels(y, x) = label;
    });
    return true;
  }
  ForegroundComponents take() { return std::move(found_); }

 private:
  template <typename Work>
  static void forEach(const cv::Mat1b& pixels, const Work& work) {
    for (int y = 0; y < pixels.rows; ++y) {
      const uint8_t* const row = pixels[y];
      for (int x = 0; x < pixels.cols; ++x) {
        if (row[x] != 0) work(y, x);
      }
    }
  }

  const cv::Mat1b& probability_;
  ForegroundComponents found_;
  std::vector<cv::Rect> claimed_;
};

}  // namespace

const BoostedTrees& objectTrees() {
  static const BoostedTrees trees(objectTreesText());
  return trees;
}

std::vector<Candidate> findCandidates(const ForegroundMaps& maps, const cv::Mat1b& unknown,
                                      const std::optional<GroundPlane>& ground, const BoostedTrees& trees) {
  std::vector<Candidate> candidates;
  const cv::Size size = maps.appearance.size();
  RegionMeter meter(maps, unknown.size(), ground);
  cv::Mat1b no_statement;
  cv::resize(unknown, no_statement, size, 0, 0, cv::INTER_NEAREST);
  const double pixel_px2 = static_cast<double>(unknown.size().area()) / size.area();
  for (size_t level = 0; level < kLevels.size(); ++level) {
    cv::Mat1b mask = maps.appearance > kLevels[level];
    mask.setTo(0, no_statement);
    const ConnectedRegions regions(mask);
    for (size_t i = 0; i < regions.size(); ++i) {
      const double area_px2 = regions.area(i) * pixel_px2;
      if (area_px2 < kLeastArea_px2 || area_px2 > kMostArea_px2) continue;
      const cv::Rect& box = regions.box(i);
      if (greatestForeground(maps, box) <= kLeastForeground) continue;
      Candidate candidate{box, regions.pixels(i)};
      if (greatestForeground(maps, box, candidate.pixels) <= kLeastForeground) continue;
      candidate.features = meter.measure(box, candidate.pixels, level);
      candidate.log_odds = trees.logOdds(candidate.features.data());
      candidates.push_back(std::move(candidate));
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.log_odds > b.log_odds; });
  return candidates;
}

ForegroundComponents componentsOf(const std::vector<Candidate>& candidates, const cv::Mat1b& probability,
                                  const cv::Mat1b& unknown, const ObjectParameters& parameters,
                                  const ForegroundMaps& maps) {
  const ForegroundComponents of_foreground =
      findComponents(probability, unknown, parameters, {maps.gain, maps.residual, {}});
  ComponentSet set(probability,
                   of_foreground.part | partOf(candidates, maps.appearance.size(), probability.size()));
  for (size_t i = 0; i < of_foreground.components.size(); ++i) {
    const Component& component = of_foreground.components[i];
    if (component.area_px > kMostArea_px2) set.add(component, of_foreground.pixelsOf(i));
  }
  cv::Mat1b pixels;
  for (const Candidate& candidate : candidates) {
    const double log_odds = candidate.log_odds + kCaution;
    if (log_odds < kLeastLogOdds) break;
    Component component;
    component.box = inImage(candidate.box, maps.appearance.size(), probability.size());
    if (set.isDoubled(component.box)) continue;
    if (log_odds < kSureLogOdds && areDoubled(of_foreground, component.box)) continue;
    cv::resize(candidate.pixels, pixels, component.box.size(), 0, 0, cv::INTER_NEAREST);
    pixels.setTo(0, unknown(component.box));
    component.peak = 1 / (1 + std::exp(-log_odds));
    if (!maps.residual.empty())
      component.residual_around = meanAround(maps.residual, probability.size(), component.box);
    if (set.add(component, pixels)) set.claim(component.box);
  }
  for (size_t i = 0; i < of_foreground.components.size(); ++i) {
    const Component& component = of_foreground.components[i];
    if (component.area_px > kMostArea_px2 || set.isDoubled(component.box)) continue;
    set.add(component, of_foreground.pixelsOf(i));  // of a kind that the trees do not know
  }
  return set.take();
}

}  // namespace redbee
