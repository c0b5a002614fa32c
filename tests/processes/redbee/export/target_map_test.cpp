// Paths over the line where the longitude changes its sign (RFC 7946, 3.1.9).
#include "processes/redbee/export/target_map.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace redbee::test {
namespace {

using Json = nlohmann::json;

/// East over it and back: 0.2 degrees of longitude and 0.1 of latitude each second.
RecordedFlight flightOverTheAntimeridian() {
  RecordedFlight flight;
  const double longitudes[] = {179.7, 179.9, -179.9, -179.7, -179.9, 179.9};
  RecordedTarget target;
  for (int k = 0; k < 6; ++k) {
    RecordedPlace place;
    place.utime = 1'000'000 * k;
    place.latitude_deg = 10 + 0.1 * k;
    place.longitude_deg = longitudes[k];
    flight.vehicle.push_back(place);
    target.places.push_back(place);
    target.sigmas_m.push_back(k);
  }
  target.state = "moving";
  flight.targets[5] = target;
  return flight;
}

Json featureOf(const Json& map, const std::string& what) {
  for (const Json& feature : map["features"]) {
    if (feature["properties"]["what"] == what) return feature;
  }
  return {};
}

TEST(TargetMap, GeoJsonPathsAreCutAtTheAntimeridian) {
  const Json map = Json::parse(asGeoJson(flightOverTheAntimeridian()));
  const Json path = featureOf(map, "path");
  ASSERT_EQ(path["geometry"]["type"], "MultiLineString");
  const Json expected = {{{179.7, 10.0}, {179.9, 10.1}, {180.0, 10.15}},
                         {{-180.0, 10.15}, {-179.9, 10.2}, {-179.7, 10.3}, {-179.9, 10.4}, {-180.0, 10.45}},
                         {{180.0, 10.45}, {179.9, 10.5}}};
  const Json& lines = path["geometry"]["coordinates"];
  ASSERT_EQ(lines.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(lines[i].size(), expected[i].size()) << lines[i];
    for (size_t k = 0; k < lines[i].size(); ++k) {
      for (int c = 0; c < 2; ++c)
        EXPECT_NEAR(lines[i][k][c].get<double>(), expected[i][k][c].get<double>(), 1e-7);
    }
  }
  EXPECT_EQ(path["properties"]["utime_us"], Json({{0, 1'000'000, 1'500'000},
                                                  {1'500'000, 2'000'000, 3'000'000, 4'000'000, 4'500'000},
                                                  {4'500'000, 5'000'000}}));
  EXPECT_EQ(path["properties"]["sigma_m"], Json({{0.0, 1.0, 1.5}, {1.5, 2.0, 3.0, 4.0, 4.5}, {4.5, 5.0}}));
  EXPECT_EQ(featureOf(map, "vehicle")["geometry"], path["geometry"]);
}

TEST(TargetMap, APathThatDoesNotCrossItIsOneLine) {
  RecordedFlight flight = flightOverTheAntimeridian();
  flight.vehicle.resize(2);
  const Json vehicle = featureOf(Json::parse(asGeoJson(flight)), "vehicle");
  EXPECT_EQ(vehicle["geometry"]["type"], "LineString");
  EXPECT_EQ(vehicle["properties"]["utime_us"], Json({0, 1'000'000}));
}

TEST(TargetMap, KmlPathsAreCutAtTheAntimeridian) {
  const std::string kml = asKml(flightOverTheAntimeridian(), "flight");
  const auto count = [&](const std::string& text) {
    int found = 0;
    for (size_t at = kml.find(text); at != std::string::npos; at = kml.find(text, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("<gx:MultiTrack>"), 2);
  EXPECT_EQ(count("<gx:Track>"), 6);
  EXPECT_EQ(count("<gx:coord>180.0000000 10.1500000 0</gx:coord>"), 2);
  EXPECT_EQ(count("<gx:coord>-180.0000000 10.1500000 0</gx:coord>"), 2);
  EXPECT_EQ(count("<when>"), count("<gx:coord>"));
}

}  // namespace
}  // namespace redbee::test
