// A flight and its targets for a map.
#pragma once

#include <string>

#include "processes/redbee/export/recorded_targets.hpp"

namespace redbee {

/// GeoJSON (RFC 7946), one FeatureCollection: the vehicle's path, and of each target its path, where it has
/// more than one place, and its last place. Times are microseconds of the log.
/// A path over the antimeridian is a MultiLineString, and the lists of its times and sigmas have the same
/// parts.
std::string asGeoJson(const RecordedFlight& flight);
/// The same in KML 2.2, on the ground; paths are Google's gx:Track, whose times are the log's as if they
/// counted from 1970.
std::string asKml(const RecordedFlight& flight, const std::string& name);

}  // namespace redbee
