#include "processes/redbee/export/target_map.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>

namespace redbee {
namespace {

using OrderedJson = nlohmann::ordered_json;

double rounded(double value, double unit) { return std::round(value / unit) * unit; }

/// RFC 7946: longitude, latitude; seven places are a centimetre.
OrderedJson positionOf(const RecordedPlace& place) {
  return {rounded(place.longitude_deg, 1e-7), rounded(place.latitude_deg, 1e-7)};
}

OrderedJson feature(OrderedJson geometry, OrderedJson properties) {
  return {{"type", "Feature"}, {"geometry", std::move(geometry)}, {"properties", std::move(properties)}};
}

/// A part of a path: places, and of a target's path their sigmas.
struct PathPart {
  std::vector<RecordedPlace> places;
  std::vector<double> sigmas_m;

  void add(const RecordedPlace& place, double sigma) {
    places.push_back(place);
    sigmas_m.push_back(sigma);
  }
};

RecordedPlace between(const RecordedPlace& a, const RecordedPlace& b, double part, double longitude_deg) {
  RecordedPlace place = a;
  place.utime += static_cast<int64_t>(std::llround(part * static_cast<double>(b.utime - a.utime)));
  place.latitude_deg += part * (b.latitude_deg - a.latitude_deg);
  place.altitude_m += part * (b.altitude_m - a.altitude_m);
  place.longitude_deg = longitude_deg;
  return place;
}

/// Maps draw a line from 179.9 to -179.9 degrees round the world: each part ends at the antimeridian (RFC
/// 7946, 3.1.9), and the next begins there. `sigmas_m` may be empty.
std::vector<PathPart> cutAtAntimeridian(const std::vector<RecordedPlace>& places,
                                        const std::vector<double>& sigmas_m) {
  constexpr double kHalfTurn = 180, kTurn = 360;
  const auto sigmaOf = [&](size_t i) { return sigmas_m.empty() ? 0 : sigmas_m[i]; };
  std::vector<PathPart> parts(1);
  for (size_t i = 0; i < places.size(); ++i) {
    if (i > 0 && std::abs(places[i].longitude_deg - places[i - 1].longitude_deg) > kHalfTurn) {
      const RecordedPlace &a = places[i - 1], &b = places[i];
      const double side = a.longitude_deg > 0 ? kHalfTurn : -kHalfTurn;
      const double whole = b.longitude_deg + std::copysign(kTurn, side) - a.longitude_deg;
      const double part = whole == 0 ? 0 : (side - a.longitude_deg) / whole;
      const double sigma = sigmaOf(i - 1) + part * (sigmaOf(i) - sigmaOf(i - 1));
      parts.back().add(between(a, b, part, side), sigma);
      parts.emplace_back();
      parts.back().add(between(a, b, part, -side), sigma);
    }
    parts.back().add(places[i], sigmaOf(i));
  }
  return parts;
}

/// One line, or one for each part; what belongs to its places has the same form.
OrderedJson pathOf(const std::vector<PathPart>& parts) {
  OrderedJson lines = OrderedJson::array();
  for (const PathPart& part : parts) {
    OrderedJson coordinates = OrderedJson::array();
    for (const RecordedPlace& place : part.places) coordinates.push_back(positionOf(place));
    lines.push_back(std::move(coordinates));
  }
  if (parts.size() == 1) return {{"type", "LineString"}, {"coordinates", std::move(lines[0])}};
  return {{"type", "MultiLineString"}, {"coordinates", std::move(lines)}};
}

template <typename Value>
OrderedJson listed(const std::vector<PathPart>& parts, const Value& valueOf) {
  OrderedJson lists = OrderedJson::array();
  for (const PathPart& part : parts) {
    OrderedJson list = OrderedJson::array();
    for (size_t i = 0; i < part.places.size(); ++i) list.push_back(valueOf(part, i));
    lists.push_back(std::move(list));
  }
  return parts.size() == 1 ? lists[0] : lists;
}

OrderedJson timesOf(const std::vector<PathPart>& parts) {
  return listed(parts, [](const PathPart& part, size_t i) { return part.places[i].utime; });
}

OrderedJson sigmasOf(const std::vector<PathPart>& parts) {
  return listed(parts, [](const PathPart& part, size_t i) { return rounded(part.sigmas_m[i], 0.01); });
}

OrderedJson pathFeature(int id, const RecordedTarget& target) {
  const auto parts = cutAtAntimeridian(target.places, target.sigmas_m);
  return feature(
      pathOf(parts),
      {{"what", "path"}, {"target", id}, {"utime_us", timesOf(parts)}, {"sigma_m", sigmasOf(parts)}});
}

OrderedJson vehicleFeature(const std::vector<RecordedPlace>& places) {
  const auto parts = cutAtAntimeridian(places, {});
  return feature(pathOf(parts), {{"what", "vehicle"}, {"utime_us", timesOf(parts)}});
}

OrderedJson placeProperties(int id, const RecordedTarget& target) {
  return {{"what", "last place"},
          {"target", id},
          {"state", target.state},
          {"utime_us", target.places.back().utime},
          {"sigma_m", rounded(target.sigmas_m.back(), 0.01)},
          {"speed_m_s", rounded(target.speed_m_s, 0.01)},
          {"course_deg", rounded(target.course_deg, 0.1)},
          {"width_m", rounded(target.width_m, 0.01)},
          {"height_m", rounded(target.height_m, 0.01)}};
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return out;
}

/// xsd:dateTime, to the millisecond.
std::string timeText(int64_t utime) {
  const int64_t milliseconds = utime / 1000;
  const std::time_t seconds = milliseconds / 1000;
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", parts.tm_year + 1900, parts.tm_mon + 1,
                     parts.tm_mday, parts.tm_hour, parts.tm_min, parts.tm_sec, milliseconds % 1000);
}

std::string placemark(const std::string& name, const std::string& style, const std::string& description,
                      const std::string& geometry, const std::string& time = "") {
  return fmt::format(
      "  <Placemark>\n    <name>{}</name>\n    <description>{}</description>\n{}"
      "    <styleUrl>#{}</styleUrl>\n    {}\n  </Placemark>\n",
      escaped(name), escaped(description), time, style, geometry);
}

/// A path with the time of each place, on the ground.
std::string trackOf(const std::vector<RecordedPlace>& places) {
  std::string times;
  std::string coordinates;
  for (const RecordedPlace& place : places) {
    times += "<when>" + timeText(place.utime) + "</when>\n";
    coordinates +=
        fmt::format("<gx:coord>{:.7f} {:.7f} 0</gx:coord>\n", place.longitude_deg, place.latitude_deg);
  }
  return "<gx:Track><altitudeMode>clampToGround</altitudeMode>\n" + times + coordinates + "</gx:Track>";
}

std::string tracksOf(const std::vector<RecordedPlace>& places) {
  const auto parts = cutAtAntimeridian(places, {});
  if (parts.size() == 1) return trackOf(places);
  std::string tracks;
  for (const PathPart& part : parts) tracks += trackOf(part.places) + "\n";
  return "<gx:MultiTrack>\n" + tracks + "</gx:MultiTrack>";
}

std::string pointOf(const RecordedPlace& place) {
  return fmt::format("<Point><coordinates>{:.7f},{:.7f}</coordinates></Point>", place.longitude_deg,
                     place.latitude_deg);
}

std::string styleOf(const char* id, const char* colour, int width) {
  return fmt::format(
      "  <Style id=\"{}\"><LineStyle><color>{}</color><width>{}</width></LineStyle>"
      "<IconStyle><color>{}</color></IconStyle></Style>\n",
      id, colour, width, colour);
}

}  // namespace

std::string asGeoJson(const RecordedFlight& flight) {
  OrderedJson features = OrderedJson::array();
  if (flight.vehicle.size() > 1) features.push_back(vehicleFeature(flight.vehicle));
  for (const auto& [id, target] : flight.targets) {
    if (target.places.size() > 1) features.push_back(pathFeature(id, target));
    features.push_back(feature({{"type", "Point"}, {"coordinates", positionOf(target.places.back())}},
                               placeProperties(id, target)));
  }
  return OrderedJson{{"type", "FeatureCollection"}, {"features", std::move(features)}}.dump() + "\n";
}

std::string asKml(const RecordedFlight& flight, const std::string& name) {
  // Colours are alpha, blue, green, red: blue and orange, which the colour-blind can tell.
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml "
      "xmlns=\"http://www.opengis.net/kml/2.2\" xmlns:gx=\"http://www.google.com/kml/ext/2.2\">\n<Document>\n"
      "  <name>" +
      escaped(name) + "</name>\n" + styleOf("vehicle", "ffb27200", 2) + styleOf("target", "ff009fe6", 3);
  if (flight.vehicle.size() > 1) text += placemark("vehicle", "vehicle", "path", tracksOf(flight.vehicle));
  for (const auto& [id, target] : flight.targets) {
    const std::string title = "target " + std::to_string(id);
    if (target.places.size() > 1) text += placemark(title, "target", "path", tracksOf(target.places));
    const std::string description = fmt::format(
        "{}, {:.1f} m/s towards {:.0f} deg, within {:.1f} m (one sigma), {:.1f} m x {:.1f} m", target.state,
        target.speed_m_s, target.course_deg, target.sigmas_m.back(), target.width_m, target.height_m);
    // From then on: nobody takes it away from where it was last.
    const std::string since =
        "    <TimeSpan><begin>" + timeText(target.places.back().utime) + "</begin></TimeSpan>\n";
    text += placemark(title, "target", description, pointOf(target.places.back()), since);
  }
  return text + "</Document>\n</kml>\n";
}

}  // namespace redbee
