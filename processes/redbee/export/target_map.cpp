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

OrderedJson pathOf(const std::vector<RecordedPlace>& places) {
  OrderedJson coordinates = OrderedJson::array();
  for (const RecordedPlace& place : places) coordinates.push_back(positionOf(place));
  return {{"type", "LineString"}, {"coordinates", std::move(coordinates)}};
}

OrderedJson timesOf(const std::vector<RecordedPlace>& places) {
  OrderedJson times = OrderedJson::array();
  for (const RecordedPlace& place : places) times.push_back(place.utime);
  return times;
}

OrderedJson pathProperties(int id, const RecordedTarget& target) {
  OrderedJson sigmas = OrderedJson::array();
  for (const double sigma : target.sigmas_m) sigmas.push_back(rounded(sigma, 0.01));
  return {
      {"what", "path"}, {"target", id}, {"utime_us", timesOf(target.places)}, {"sigma_m", std::move(sigmas)}};
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
  if (flight.vehicle.size() > 1)
    features.push_back(
        feature(pathOf(flight.vehicle), {{"what", "vehicle"}, {"utime_us", timesOf(flight.vehicle)}}));
  for (const auto& [id, target] : flight.targets) {
    if (target.places.size() > 1)
      features.push_back(feature(pathOf(target.places), pathProperties(id, target)));
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
  if (flight.vehicle.size() > 1) text += placemark("vehicle", "vehicle", "path", trackOf(flight.vehicle));
  for (const auto& [id, target] : flight.targets) {
    const std::string title = "target " + std::to_string(id);
    if (target.places.size() > 1) text += placemark(title, "target", "path", trackOf(target.places));
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
