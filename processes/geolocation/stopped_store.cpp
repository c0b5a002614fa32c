#include "processes/geolocation/stopped_store.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "redbee/files/atomic_file.hpp"
#include "redbee/node/covariance_check.hpp"

namespace redbee {
namespace {

constexpr int64_t kPeriod_us = 1'000'000;
constexpr double kMostMetres = 1e5;  // of a size or a range

struct Stored {
  int64_t utime = 0;
  Geodetic place;
  StoppedTarget target;
};

std::string lineOf(int64_t utime, const Geodetic& place, const StoppedTarget& target) {
  const Eigen::Matrix2d& P = target.covariance;
  return fmt::format("{} {} {:.9f} {:.9f} {:.9g} {:.9g} {:.9g} {:.4g} {:.4g} {:.6g} {:.3f}\n", utime,
                     target.id, place.latitude_deg, place.longitude_deg, P(0, 0), P(0, 1), P(1, 1),
                     target.size.x(), target.size.y(), target.range_m, target.unseen_s);
}

bool isTarget(const Stored& stored) {
  const StoppedTarget& t = stored.target;
  const Eigen::Matrix2d& P = t.covariance;
  const double covariance[] = {P(0, 0), P(0, 1), P(1, 0), P(1, 1)};
  const auto isLength = [](double x) { return x >= 0 && x <= kMostMetres; };
  return std::abs(stored.place.latitude_deg) <= 90 && std::abs(stored.place.longitude_deg) <= 180 &&
         t.id > 0 && message_limits::isCovariance(covariance) && isLength(t.size.x()) &&
         isLength(t.size.y()) && isLength(t.range_m) && t.unseen_s >= 0;
}

/// False for a line that is none of ours.
bool parseStored(const std::string& line, Stored& stored) {
  std::istringstream in(line);
  StoppedTarget& t = stored.target;
  Eigen::Matrix2d& P = t.covariance;
  in >> stored.utime >> t.id >> stored.place.latitude_deg >> stored.place.longitude_deg >> P(0, 0) >>
      P(0, 1) >> P(1, 1) >> t.size.x() >> t.size.y() >> t.range_m >> t.unseen_s;
  P(1, 0) = P(0, 1);
  return !in.fail() && isTarget(stored);
}

}  // namespace

void StoppedStore::restore(int64_t utime, const LocalFrame& frame, Geolocator& geolocator) {
  if (is_restored_ || file_.empty() || !frame.isGlobal()) return;
  is_restored_ = true;
  std::ifstream file(file_);
  for (std::string line; std::getline(file, line);) {
    Stored stored;
    if (!parseStored(line, stored)) {
      spdlog::warn("{}: holds something else than stopped targets: ignored", file_.string());
      return;
    }
    if (stored.utime > utime) continue;
    stored.target.position = frame.positionOf(stored.place);
    stored.target.unseen_s += static_cast<double>(utime - stored.utime) * 1e-6;
    geolocator.restore(stored.target);
  }
}

void StoppedStore::keep(int64_t utime, const LocalFrame& frame, const Geolocator& geolocator) {
  if (file_.empty() || !is_restored_ || !frame.isGlobal()) return;
  const std::vector<StoppedTarget> stopped = geolocator.stopped();
  std::vector<int> ids;
  std::string text;
  for (const StoppedTarget& target : stopped) {
    ids.push_back(target.id);
    text += lineOf(utime, frame.geodeticOf(target.position), target);
  }
  const bool is_due = !ids.empty() && utime - written_utime_ >= kPeriod_us;
  if (ids == written_ && !is_due) return;
  written_ = std::move(ids);
  written_utime_ = utime;
  try {
    writeAtomically(file_, text);
  } catch (const std::exception& error) {
    spdlog::warn("who has stopped is not known after a restart: {}", error.what());
    file_.clear();
  }
}

}  // namespace redbee
