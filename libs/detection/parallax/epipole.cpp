#include "redbee/detection/parallax/epipole.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <vector>

namespace redbee {
namespace {

constexpr int kStep_px = 6;              // between the samples
constexpr float kSignificant = 3;        // sigmas of a residual flow that has a direction
constexpr float kDirectionError = 0.1F;  // rad, of the residual flow of a static surface
constexpr float kWithin = 2.5F;          // sigmas
constexpr int kHypotheses = 200;         // of RANSAC
constexpr int kRefinements = 3;
constexpr size_t kFewest = 30;         // samples
constexpr double kAgreeing = 0.6;      // least fraction of the samples
constexpr double kSpread = 0.08;       // of the image's height: least standard deviation across the parallax
constexpr double kTravelAngle = 0.35;  // rad: a homography of short translation gives no better direction
constexpr double kMostRoll = 0.7;      // x component of the ground's normal
constexpr double kCoverage = 0.2;      // least fraction of the image's cells, on average
constexpr double kSpan_s = 0.5;        // of that average
constexpr double kNearest = 0.95;      // quantile of the samples' parallax, and
constexpr float kBeyond = 1.5F;        // so many times as much may be static
constexpr float kTiny = 1e-20F;

/// A residual flow with a direction. Positions and epipoles in here are in units of half the image's width,
/// about its centre.
struct Sample {
  cv::Vec2f ground;
  cv::Vec2f flow;  ///< px
  float variance;  ///< px^2, of the flow across the parallax of a static surface
};

/// Counts the cells of a grid over the image that hold several samples; a single one may be noise.
class Coverage {
 public:
  void add(const cv::Vec2f& px, cv::Size image) {
    const auto cell = [](float at, int length, int cells) {
      return std::clamp(static_cast<int>(at * static_cast<float>(cells) / static_cast<float>(length)), 0,
                        cells - 1);
    };
    held_[static_cast<size_t>(cell(px[1], image.height, kRows) * kColumns +
                              cell(px[0], image.width, kColumns))] += 1;
  }
  double cells() const {
    return static_cast<double>(
        std::count_if(held_.begin(), held_.end(), [](int samples) { return samples >= kSeveral; }));
  }

 private:
  static constexpr int kColumns = 8, kRows = 6, kSeveral = 3;
  std::array<int, kColumns * kRows> held_{};
};

float cross(const cv::Vec2f& a, const cv::Vec2f& b) { return a[0] * b[1] - a[1] * b[0]; }

float cosine(const cv::Vec2f& a, const cv::Vec2f& b) {
  return a.dot(b) / std::sqrt(a.dot(a) * b.dot(b) + kTiny);
}

bool agrees(const cv::Vec3f& e, const Sample& sample) {
  const cv::Vec2f along = parallaxOf(e, sample.ground);
  const float across = cross(along, sample.flow);
  return along.dot(sample.flow) > 0 &&
         across * across <= kWithin * kWithin * sample.variance * along.dot(along);
}

/// `known`: the cells in which there is flow.
std::vector<Sample> significantFlow(const EpipoleInput& input, Coverage& known) {
  std::vector<Sample> samples;
  const cv::Size image = input.flow.size();
  for (int y = kStep_px / 2; y < image.height; y += kStep_px) {
    for (int x = kStep_px / 2; x < image.width; x += kStep_px) {
      if (input.unknown(y, x) != 0) continue;
      const cv::Vec2f pixel(static_cast<float>(x), static_cast<float>(y));
      known.add(pixel, image);
      const cv::Vec2f back = input.flow(y, x);
      const cv::Vec2f forth = -back - input.error.at(pixel[0], pixel[1]);
      const float length2 = forth.dot(forth);
      const float variance = input.noise.largest(y, x);
      if (length2 < kSignificant * kSignificant * variance) continue;
      samples.push_back({(pixel + back - input.error.middle) * (1 / input.error.unit), forth,
                         variance + kDirectionError * kDirectionError * length2});
    }
  }
  return samples;
}

/// Epipoles of the camera's translation by the ground's homography: up to two, which cannot be told apart
/// without knowing the plane.
std::vector<cv::Vec3f> directionsOfTravel(const EpipoleInput& input) {
  std::vector<cv::Mat> rotations, translations, normals;
  // As if the lens had not zoomed in between: the decomposition knows one camera matrix.
  const cv::Matx33d ground =
      input.K_earlier == input.K ? input.ground : input.ground * input.K_earlier * input.K.inv();
  cv::decomposeHomographyMat(ground, input.K, rotations, translations, normals);
  std::vector<cv::Vec3f> directions;
  for (size_t i = 0; i < translations.size(); ++i) {
    const cv::Vec3d normal(normals[i]);
    if (normal[2] < 0 || std::abs(normal[0]) > kMostRoll) continue;  // behind the camera, or on its side
    const cv::Vec3f e = input.K * cv::Vec3d(translations[i]);
    directions.emplace_back(e[0] - e[2] * input.error.middle[0], e[1] - e[2] * input.error.middle[1],
                            e[2] * input.error.unit);
  }
  return directions;
}

/// True if the parallax of `e` has the direction of one of `others`, on average over the image.
bool isAmong(const std::vector<cv::Vec3f>& others, const cv::Vec3f& e, cv::Size image) {
  static constexpr int kSide = 4;  // places, each way
  const float aspect = static_cast<float>(image.height) / static_cast<float>(image.width);
  return std::any_of(others.begin(), others.end(), [&](const cv::Vec3f& other) {
    float sum = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
      const auto middle_of = [](int cell) { return 2 * (static_cast<float>(cell) + 0.5F) / kSide - 1; };
      const cv::Vec2f place(middle_of(i % kSide), aspect * middle_of(i / kSide));
      sum += cosine(parallaxOf(e, place), parallaxOf(other, place));
    }
    return sum > std::cos(kTravelAngle) * kSide * kSide;
  });
}

std::optional<cv::Vec3f> bestHypothesis(const std::vector<Sample>& samples,
                                        const std::vector<cv::Vec3f>& travel, cv::Size image) {
  const auto line = [](const Sample& s) {
    return cv::Vec3f(s.ground[0], s.ground[1], 1).cross(cv::Vec3f(s.flow[0], s.flow[1], 0));
  };
  cv::RNG random(1);
  const auto any = [&]() -> const Sample& {
    return samples[static_cast<size_t>(random.uniform(0, static_cast<int>(samples.size())))];
  };
  std::optional<cv::Vec3f> best;
  long most = 0;
  for (int i = 0; i < kHypotheses; ++i) {
    const Sample& first = any();
    cv::Vec3f e = cv::normalize(line(first).cross(line(any())));
    if (parallaxOf(e, first.ground).dot(first.flow) < 0) e = -e;
    if (!isAmong(travel, e, image)) continue;
    const long agreeing =
        std::count_if(samples.begin(), samples.end(), [&](const Sample& s) { return agrees(e, s); });
    if (agreeing <= most) continue;
    most = agreeing;
    best = e;
  }
  return best;
}

/// Least squares over the samples that agree.
cv::Vec3f refined(const std::vector<Sample>& samples, cv::Vec3f e) {
  for (int round = 0; round < kRefinements; ++round) {
    cv::Matx33f normal = cv::Matx33f::zeros();
    for (const Sample& s : samples) {
      if (!agrees(e, s)) continue;
      const cv::Vec2f along = parallaxOf(e, s.ground);
      const cv::Vec3f row(s.flow[1], -s.flow[0], s.flow[0] * s.ground[1] - s.flow[1] * s.ground[0]);
      normal += row * row.t() * (1 / (s.variance * along.dot(along) + kTiny));
    }
    cv::Matx31f values;
    cv::Matx33f vectors;  // rows; the last one belongs to the smallest value
    if (!cv::eigen(normal, values, vectors)) return e;
    const cv::Vec3f next(vectors(2, 0), vectors(2, 1), vectors(2, 2));
    e = next.dot(e) < 0 ? -next : next;
  }
  return e;
}

/// The samples that agree on an epipole.
struct Consensus {
  std::vector<float> depths;  ///< parallax over that of the unscaled epipole
  double spread = 0;          ///< standard deviation of their positions across the parallax
  Coverage places;
};

Consensus consensusOn(const cv::Vec3f& e, const std::vector<Sample>& samples, const EpipoleInput& input) {
  Consensus found;
  double sum = 0, sum2 = 0;
  for (const Sample& s : samples) {
    if (!agrees(e, s)) continue;
    const cv::Vec2f along = parallaxOf(e, s.ground);
    found.depths.push_back(along.dot(s.flow) / along.dot(along));
    const double across = cross(along, s.ground) / std::sqrt(along.dot(along));
    sum += across;
    sum2 += across * across;
    found.places.add(s.ground * input.error.unit + input.error.middle, input.flow.size());
  }
  const double count = std::max(1.0, static_cast<double>(found.depths.size()));
  found.spread = std::sqrt(std::max(0.0, sum2 / count - sum * sum / (count * count)));
  return found;
}

}  // namespace

std::optional<cv::Vec3f> EpipoleEstimator::update(const EpipoleInput& input, double elapsed_s) {
  Coverage known;
  const std::vector<Sample> samples = significantFlow(input, known);
  std::optional<cv::Vec3f> best;
  if (samples.size() >= kFewest) best = bestHypothesis(samples, directionsOfTravel(input), input.flow.size());
  Consensus consensus;
  double coverage = 0;
  if (best) {
    best = refined(samples, *best);
    consensus = consensusOn(*best, samples, input);
    const auto agreeing = static_cast<double>(consensus.depths.size());
    const bool agreed = consensus.depths.size() >= kFewest &&
                        agreeing >= kAgreeing * static_cast<double>(samples.size()) &&
                        consensus.spread * input.error.unit >= kSpread * input.flow.rows;
    if (agreed) coverage = consensus.places.cells() / known.cells();
  }
  ++support_.frames;
  const double rate = std::clamp(elapsed_s / kSpan_s, 1.0 / support_.frames, 1.0);
  support_.mean += rate * (coverage - support_.mean);
  if (coverage == 0 || support_.mean < kCoverage) return std::nullopt;
  const auto nearest = consensus.depths.begin() +
                       static_cast<long>(kNearest * static_cast<double>(consensus.depths.size() - 1));
  std::nth_element(consensus.depths.begin(), nearest, consensus.depths.end());
  cv::Vec3f e = kBeyond * *nearest * *best;
  e[2] /= input.error.unit;
  e[0] += e[2] * input.error.middle[0];
  e[1] += e[2] * input.error.middle[1];
  return e;
}

}  // namespace redbee
