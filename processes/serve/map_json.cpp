#include "processes/serve/map_json.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "processes/geolocation/target_messages.hpp"

namespace redbee {
namespace {

nlohmann::json rounded(const Eigen::Vector2d& point) {
  constexpr double kSteps = 100;  // a hundredth of a pixel or of a metre
  return {std::round(point.x() * kSteps) / kSteps, std::round(point.y() * kSteps) / kSteps};
}

nlohmann::json ellipseJson(const Eigen::Matrix2d& covariance) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeDirect(covariance);
  const Eigen::Vector2d sigmas = solver.eigenvalues().cwiseMax(0).cwiseSqrt();  // increasing
  const Eigen::Vector2d along = solver.eigenvectors().col(1);
  return {{"major", sigmas.y()}, {"minor", sigmas.x()}, {"angle", std::atan2(along.x(), along.y())}};
}

nlohmann::json targetJson(const MapTarget& target) {
  nlohmann::json result{{"id", target.id},
                        {"state", stateName(target.state)},
                        {"position", rounded(target.position)},
                        {"velocity", rounded(target.velocity)},
                        {"speed", target.velocity.norm()},
                        {"size", rounded(target.size)},
                        {"unseen", target.unseen_s},
                        {"ellipse", ellipseJson(target.covariance)}};
  if (target.place) {
    result["latitude"] = target.place->latitude_deg;
    result["longitude"] = target.place->longitude_deg;
  }
  return result;
}

}  // namespace

nlohmann::json pointsJson(const std::vector<Eigen::Vector2d>& points) {
  nlohmann::json result = nlohmann::json::array();
  for (const Eigen::Vector2d& point : points) result.push_back(rounded(point));
  return result;
}

nlohmann::json mapJson(const MapView& map) {
  nlohmann::json result{{"note", map.note},
                        {"path", pointsJson(map.path)},
                        {"footprint", pointsJson(map.footprint)},
                        {"targets", nlohmann::json::array()}};
  if (map.targets_utime) result["targets_utime"] = *map.targets_utime;
  if (map.origin) {
    result["origin"] = {{"latitude", map.origin->latitude_deg}, {"longitude", map.origin->longitude_deg}};
  }
  for (const MapTarget& target : map.targets) result["targets"].push_back(targetJson(target));
  if (map.own) {
    result["own"] = {{"position", rounded(map.own->position)}, {"heading", map.own->heading_rad}};
    if (map.own->height_m) result["own"]["height"] = *map.own->height_m;
    if (map.own->axis_on_ground) result["own"]["axis"] = rounded(*map.own->axis_on_ground);
  }
  return result;
}

}  // namespace redbee
