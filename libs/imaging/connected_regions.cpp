#include "redbee/imaging/connected_regions.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <tuple>

namespace redbee {
namespace {

/// The first place from `at` on that is not 0; `width` if there is none.
int nextSet(const uint8_t* row, int at, int width) {
  constexpr int kWord = sizeof(uint64_t);
  for (; at + kWord <= width; at += kWord) {
    uint64_t word = 0;
    std::memcpy(&word, row + at, sizeof(word));
    if (word != 0) break;
  }
  while (at < width && row[at] == 0) ++at;
  return at;
}

int nextClear(const uint8_t* row, int at, int width) {
  const void* found = std::memchr(row + at, 0, static_cast<size_t>(width - at));
  return found == nullptr ? width : static_cast<int>(static_cast<const uint8_t*>(found) - row);
}

}  // namespace

ConnectedRegions::ConnectedRegions(const cv::Mat1b& mask) {
  constexpr size_t kRunsOfRow = 4;  // typically
  runs_.reserve(kRunsOfRow * static_cast<size_t>(mask.rows));
  for (int y = 0; y < mask.rows; ++y) addRow(mask[y], y, mask.cols);
  gather();
}

void ConnectedRegions::addRow(const uint8_t* row, int y, int width) {
  row_above_ = row_;
  row_ = runs_.size();
  size_t above = row_above_;
  for (int begin = nextSet(row, 0, width); begin < width;) {
    const int end = nextClear(row, begin, width);
    const int run = static_cast<int>(runs_.size());
    runs_.push_back({y, begin, end, run, -1});
    for (; above < row_ && runs_[above].begin <= end; ++above) {
      if (runs_[above].end >= begin) join(static_cast<int>(above), run);
      if (runs_[above].end > end) break;  // it may touch the next run, too
    }
    begin = nextSet(row, end, width);
  }
}

int ConnectedRegions::first(int run) const {
  for (int before = runs_[static_cast<size_t>(run)].region; before != run;) {
    run = before;
    before = runs_[static_cast<size_t>(run)].region;
  }
  return run;
}

void ConnectedRegions::join(int a, int b) {
  const int first_a = first(a), first_b = first(b), earlier = std::min(first_a, first_b);
  for (const int run : {first_a, first_b, a, b}) runs_[static_cast<size_t>(run)].region = earlier;
}

void ConnectedRegions::gather() {
  size_t count = 0;
  for (size_t i = 0; i < runs_.size(); ++i) count += runs_[i].region == static_cast<int>(i) ? 1 : 0;
  regions_.reserve(count);
  for (int i = 0; i < static_cast<int>(runs_.size()); ++i) {
    Run& run = runs_[static_cast<size_t>(i)];
    const cv::Rect box(run.begin, run.y, run.end - run.begin, 1);
    const cv::Point block(run.begin / 2, run.y / 2);
    if (run.region == i) {
      run.region = static_cast<int>(regions_.size());
      regions_.push_back({box, box.width, block, i, i});
      continue;
    }
    // An earlier run, which knows its region by now.
    run.region = runs_[static_cast<size_t>(run.region)].region;
    Region& region = regions_[static_cast<size_t>(run.region)];
    region.box |= box;
    region.area_px += box.width;
    if (std::tie(block.y, block.x) < std::tie(region.block.y, region.block.x)) region.block = block;
    runs_[static_cast<size_t>(region.last)].next = i;
    region.last = i;
  }
  std::sort(regions_.begin(), regions_.end(), [](const Region& a, const Region& b) {
    return std::tie(a.block.y, a.block.x) < std::tie(b.block.y, b.block.x);
  });
}

/// All 0.
cv::Mat1b ConnectedRegions::room(const cv::Size& size) const {
  constexpr int kPiece = 4096;  // bytes
  const int area = size.area();
  if (used_ + area > memory_.cols) {
    memory_ = cv::Mat1b(1, std::max(kPiece, area));
    used_ = 0;
  }
  cv::Mat1b part = memory_.colRange(used_, used_ + area).reshape(1, size.height);
  used_ += area;
  std::memset(part.data, 0, static_cast<size_t>(area));
  return part;
}

cv::Mat1b ConnectedRegions::pixels(size_t region) const {
  const cv::Rect& box = regions_[region].box;
  cv::Mat1b pixels = room(box.size());
  for (int i = regions_[region].first; i >= 0; i = runs_[static_cast<size_t>(i)].next) {
    const Run& run = runs_[static_cast<size_t>(i)];
    std::memset(pixels[run.y - box.y] + run.begin - box.x, 255, static_cast<size_t>(run.end - run.begin));
  }
  return pixels;
}

}  // namespace redbee
