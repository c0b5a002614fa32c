#include "redbee/detection/objects/components.hpp"

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "redbee/detection/foreground_maps.hpp"
#include "redbee/detection/objects/disc_morphology.hpp"
#include "redbee/detection/objects/moving_components.hpp"
#include "redbee/detection/objects/regions.hpp"

namespace redbee {
namespace {

constexpr double kFull = 255;  // P_FG of 1
// Where a component ends (EXPERIMENTS.md, "Objects"): at a fraction of its peak, or of the threshold if that
// is lower.
constexpr double kExtentOfPeak = 0.3;
constexpr double kExtentOfThreshold = 0.5;

/// Pixels above extent_threshold, after opening and closing. Only the bounding box of the foreground is
/// processed; it is returned in `part`.
cv::Mat1b foregroundPart(const cv::Mat1b& probability, const cv::Mat1b& unknown,
                         const ObjectParameters& parameters, cv::Rect& part) {
  cv::Mat1b mask = probability > kFull * std::min(parameters.extent_threshold, parameters.threshold);
  mask.setTo(0, unknown);
  const int reach = std::max(parameters.opening_px, parameters.closing_px);
  part = cv::boundingRect(mask);
  if (part.empty()) return {};
  part = cv::Rect(part.x - reach, part.y - reach, part.width + 2 * reach, part.height + 2 * reach) &
         cv::Rect({}, mask.size());
  mask = mask(part).clone();
  if (mask.empty()) return mask;
  openAndClose(mask, parameters.opening_px, parameters.closing_px);
  mask.setTo(0, unknown(part));
  return mask;
}

double peakOf(const cv::Mat1b& probability, const cv::Mat1b& pixels) {
  double peak = 0;
  cv::minMaxLoc(probability, nullptr, &peak, nullptr, nullptr, pixels);
  return peak;
}

/// Mean of a map, of any size, over the compared pixels of a box of an image of size `image`; 1 if none is.
double meanGain(const cv::Mat1f& map, cv::Size image, const cv::Rect& box, const cv::Mat1b& pixels) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < box.height; ++y) {
    const float* row = map[(box.y + y) * map.rows / image.height];
    for (int x = 0; x < box.width; ++x) {
      const float gain = row[(box.x + x) * map.cols / image.width];
      if (pixels(y, x) == 0 || gain == kNotCompared) continue;
      sum += gain;
      ++count;
    }
  }
  return count > 0 ? sum / count : 1;
}

/// Adds a region, if it is strong enough. `box`: of the image, in `found.part`; `pixels`: of the region in
/// it.
void add(ForegroundComponents& found, const cv::Mat1b& probability, const cv::Rect& box, int area,
         const cv::Mat1b& pixels, double weak_threshold, const ComponentMaps& maps) {
  Component component;
  component.box = box;
  component.area_px = area;
  component.score = cv::mean(probability(component.box), pixels)[0] / kFull;
  component.peak = peakOf(probability(component.box), pixels) / kFull;
  if (component.peak <= weak_threshold || found.isFull()) return;
  if (!maps.gain.empty()) component.gain = meanGain(maps.gain, probability.size(), component.box, pixels);
  if (!maps.residual.empty())
    component.residual_around = meanAround(maps.residual, probability.size(), component.box);
  found.components.push_back(component);
  found.labels(box - found.part.tl()).setTo(static_cast<double>(found.components.size()), pixels);
}

/// Of the box whose centre is nearest in units of its sides.
size_t nearestBox(const std::vector<cv::Rect2d>& boxes, int x, int y) {
  size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < boxes.size(); ++i) {
    const double dx = (x - boxes[i].x - 0.5 * boxes[i].width) / boxes[i].width;
    const double dy = (y - boxes[i].y - 0.5 * boxes[i].height) / boxes[i].height;
    const double distance = dx * dx + dy * dy;
    if (distance >= least) continue;
    least = distance;
    nearest = i;
  }
  return nearest;
}

void addForeground(ForegroundComponents& found, const cv::Mat1b& probability, const cv::Mat1b& unknown,
                   const ObjectParameters& parameters, const ComponentMaps& maps) {
  cv::Rect part;
  const cv::Mat1b foreground = foregroundPart(probability, unknown, parameters, part);
  if (foreground.empty()) return;
  found.part = part;
  if (!maps.moving.empty()) found.part |= movingPart(maps.moving, found.image, parameters.closing_px);
  found.labels = cv::Mat1w::zeros(found.part.size());
  const double min_area_px = parameters.min_area_px;
  forEachRegion(foreground, min_area_px, [&](const cv::Rect& region, int, const cv::Mat1b& own) {
    const cv::Mat1b values = probability(region + part.tl());
    const double peak = peakOf(values, own);
    if (peak <= kFull * parameters.weak_threshold) return;
    const double end = std::min(kExtentOfPeak * peak, kExtentOfThreshold * kFull * parameters.threshold);
    const cv::Mat1b extents = own & (values > end);
    forEachRegion(extents, min_area_px, [&](const cv::Rect& box, int area, const cv::Mat1b& pixels) {
      add(found, probability, box + region.tl() + part.tl(), area, pixels, parameters.weak_threshold, maps);
    });
  });
}

}  // namespace

ForegroundComponents findComponents(const cv::Mat1b& probability, const cv::Mat1b& unknown,
                                    const ObjectParameters& parameters, const ComponentMaps& maps) {
  ForegroundComponents found;
  found.image = probability.size();
  addForeground(found, probability, unknown, parameters, maps);
  if (!maps.moving.empty()) addMovingComponents(found, unknown, parameters, maps);
  return found;
}

cv::Mat1b ForegroundComponents::mask() const {
  cv::Mat1b mask = cv::Mat1b::zeros(image);
  if (!labels.empty()) mask(part).setTo(255, labels > 0);
  return mask;
}

cv::Mat1b ForegroundComponents::mask(const std::vector<size_t>& kept) const {
  cv::Mat1b mask = cv::Mat1b::zeros(image);
  for (const size_t index : kept) {
    mask(components.at(index).box).setTo(255, pixelsOf(index));
  }
  return mask;
}

cv::Mat1b ForegroundComponents::pixelsOf(size_t index) const {
  return labels(components.at(index).box - part.tl()) == static_cast<int>(index) + 1;
}

void splitComponent(ForegroundComponents& found, size_t index, const std::vector<cv::Rect2d>& boxes) {
  const Component whole = found.components.at(index);
  if (found.isFull(boxes.size() - 1)) return;
  Component empty = whole;
  empty.box = {};
  empty.area_px = 0;
  std::vector<Component> parts(boxes.size(), empty);
  const int own = static_cast<int>(index) + 1;
  const int appended = static_cast<int>(found.components.size());
  for (int y = whole.box.y; y < whole.box.br().y; ++y) {
    uint16_t* labels = found.labels[y - found.part.y];
    for (int x = whole.box.x; x < whole.box.br().x; ++x) {
      uint16_t& label = labels[x - found.part.x];
      if (label != own) continue;
      const size_t nearest = nearestBox(boxes, x, y);
      parts[nearest].box |= cv::Rect(x, y, 1, 1);
      parts[nearest].area_px += 1;
      if (nearest > 0) label = static_cast<uint16_t>(appended + static_cast<int>(nearest));
    }
  }
  found.components[index] = parts[0];
  found.components.insert(found.components.end(), parts.begin() + 1, parts.end());
}

}  // namespace redbee
