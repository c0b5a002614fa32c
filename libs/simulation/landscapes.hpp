// Landscapes that differ with the seed: flights to learn from, and to try on what no one tuned for. Height (4
// to 20 m), course, pitch, light, what stands there and what moves are drawn; in some nothing moves. In
// colour.
#pragma once

#include "redbee/simulation/flight_simulator.hpp"

namespace redbee::simulation {

/// Trees, bushes, benches, lamp posts and paths; people on foot and on bicycles.
Scenario park(unsigned seed);
/// A road with pavements, houses, trees, signs and parked cars; cars, cyclists, people.
Scenario street(unsigned seed);
/// A beach and the sea, whose surface waves; boats, rocks, trees, people.
Scenario shore(unsigned seed);

}  // namespace redbee::simulation
