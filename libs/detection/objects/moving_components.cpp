#include "redbee/detection/objects/moving_components.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "redbee/detection/objects/regions.hpp"

namespace redbee {
namespace {

constexpr double kRegion = 0.4;      // on the map: of the point's own difference from the background
constexpr double kCovered = 0.2;     // of its box, by a component's box: the component stands for it
constexpr double kConfirmed = 0.15;  // of a component's pixels that raise its gain
// P_FG of such a component is not known. Alone it says little; it is its track's path that confirms it.
constexpr double kPeak = 0.6;
constexpr double kGain = 1.5;

/// Grows the part of the image in which components are labelled.
void growPart(ForegroundComponents& found, const cv::Rect& by) {
  const cv::Rect grown = found.part | by;
  if (grown == found.part) return;
  cv::Mat1w labels = cv::Mat1w::zeros(grown.size());
  if (!found.labels.empty()) found.labels.copyTo(labels(found.part - grown.tl()));
  found.part = grown;
  found.labels = labels;
}

/// Of the map: only what is not 0, and as far around it as the closing reaches, is processed. All of it where
/// the image is no multiple of it.
cv::Rect partOfMap(const cv::Mat1f& map, cv::Size image, int closing_px) {
  constexpr int kBeside_px = 2;  // of the map, for its interpolation
  const cv::Rect whole({}, map.size());
  const int scale = std::max(1, image.width / map.cols);
  if (image != map.size() * scale) return whole;
  const cv::Rect set = cv::boundingRect(cv::Mat1b(map > 0));
  if (set.empty()) return {};
  const int reach = kBeside_px + (closing_px + scale - 1) / scale;
  return cv::Rect(set.x - reach, set.y - reach, set.width + 2 * reach, set.height + 2 * reach) & whole;
}

cv::Rect inImage(const cv::Rect& part, const cv::Mat1f& map, cv::Size image) {
  if (part.size() == map.size()) return {{}, image};
  const int scale = std::max(1, image.width / map.cols);
  return {part.tl() * scale, part.size() * scale};
}

/// Where the map, resized to the image, exceeds kRegion, with holes closed. `place`: in the image.
cv::Mat1b movingMask(const cv::Mat1f& map, cv::Size image, int closing_px, cv::Rect& place) {
  const cv::Rect part = partOfMap(map, image, closing_px);
  place = inImage(part, map, image);
  if (part.empty()) return {};
  cv::Mat1f moving;
  cv::resize(map(part), moving, place.size(), 0, 0, cv::INTER_LINEAR);
  cv::Mat1b mask = moving > kRegion;
  if (closing_px > 0) cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, disc(closing_px));
  return mask;
}

bool isCovered(const ForegroundComponents& found, size_t count, const cv::Rect& box) {
  return std::any_of(
      found.components.begin(), found.components.begin() + static_cast<std::ptrdiff_t>(count),
      [&](const Component& component) { return (component.box & box).area() > kCovered * box.area(); });
}

}  // namespace

cv::Rect movingPart(const cv::Mat1f& moving, cv::Size image, int closing_px) {
  return inImage(partOfMap(moving, image, closing_px), moving, image);
}

void addMovingComponents(ForegroundComponents& found, const cv::Mat1b& unknown,
                         const ObjectParameters& parameters, const ComponentMaps& maps) {
  cv::Rect place;
  cv::Mat1b mask = movingMask(maps.moving, found.image, parameters.closing_px, place);
  if (mask.empty()) return;
  mask.setTo(0, unknown(place));
  const cv::Rect inside = cv::boundingRect(mask), part = inside + place.tl();
  if (inside.empty()) return;
  growPart(found, part);
  const size_t count = found.components.size();
  for (size_t i = 0; i < count; ++i) {
    Component& component = found.components[i];
    const cv::Rect both = component.box & place;
    if (both.empty()) continue;
    const cv::Mat1b pixels = found.pixelsOf(i)(both - component.box.tl());
    if (cv::countNonZero(pixels & mask(both - place.tl())) > kConfirmed * component.area_px)
      component.gain = std::max(component.gain, kGain);
  }
  forEachRegion(mask(inside), parameters.min_area_px,
                [&](const cv::Rect& in_part, int, const cv::Mat1b& pixels) {
                  const cv::Rect region = in_part + part.tl();
                  if (isCovered(found, count, region) || found.isFull()) return;
                  // What a small component has already stays its own.
                  const cv::Mat1b free = pixels & (found.labels(region - found.part.tl()) == 0);
                  const int area = cv::countNonZero(free);
                  if (area < parameters.min_area_px) return;
                  const cv::Rect own = cv::boundingRect(free);
                  Component component;
                  component.box = own + region.tl();
                  component.area_px = area;
                  component.score = component.peak = kPeak;
                  if (!maps.residual.empty())
                    component.residual_around = meanAround(maps.residual, found.image, component.box);
                  found.components.push_back(component);
                  found.labels(component.box - found.part.tl())
                      .setTo(static_cast<double>(found.components.size()), free(own));
                });
}

}  // namespace redbee
