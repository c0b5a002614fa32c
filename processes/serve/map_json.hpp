// The map as the page gets it.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "processes/serve/map_view.hpp"

namespace redbee {

/// [[x, y], ...], to a hundredth of a pixel or of a metre.
nlohmann::json pointsJson(const std::vector<Eigen::Vector2d>& points);

/// {note, path, footprint, targets}, and where they are known own {position, heading, height, axis}, axis
/// being where the camera's optical axis meets the ground; origin {latitude, longitude} of position [0, 0]
/// where it is known [deg]. Positions are [east, north] in metres, angles in
/// radians from north over east. A target: {id, state: "moving", "stopped" or "coasting", position,
/// velocity, speed, unseen, size, ellipse: {major, minor, angle}}, the ellipse's half axes of one sigma in
/// metres, and where they are known latitude and longitude in degrees.
nlohmann::json mapJson(const MapView& map);

}  // namespace redbee
