#include "redbee/simulation/wave_field.hpp"

#include <cmath>
#include <random>

#include "redbee/geometry/angle.hpp"

namespace redbee::simulation {
namespace {

/// Sine of an angle in turns; the table's step shifts a wave by less than a hundredth of its amplitude.
float sineOfTurns(float turns) {
  constexpr int kEntries = 1024;
  static const std::array<float, kEntries> kTable = [] {
    std::array<float, kEntries> table{};
    for (int i = 0; i < kEntries; ++i)
      table[static_cast<size_t>(i)] = static_cast<float>(std::sin(kTurn * i / kEntries));
    return table;
  }();
  const int step = static_cast<int>(std::floor(turns * kEntries));
  return kTable[static_cast<size_t>(step & (kEntries - 1))];
}

Eigen::Vector2f direction(double turns) {
  return {static_cast<float>(std::cos(kTurn * turns)), static_cast<float>(std::sin(kTurn * turns))};
}

}  // namespace

WaveField::WaveField(const Waving& waving, double t_s) {
  std::mt19937 random(waving.seed);
  const auto uniform = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (Wave& wave : waves_) {
    const double wavelength_m = waving.wavelength_m * uniform(0.7, 1.4);
    const double frequency_hz = waving.frequency_hz * uniform(0.6, 1.5);
    wave.turns_per_m = direction(uniform(0, 1)) / static_cast<float>(wavelength_m);
    wave.shift_m = direction(uniform(0, 1)) * static_cast<float>(waving.amplitude_m);
    wave.turns_at_origin = static_cast<float>(uniform(0, 1) - std::fmod(frequency_hz * t_s, 1.0));
  }
}

Eigen::Vector2f WaveField::shiftAt(float u_m, float v_m) const {
  Eigen::Vector2f shift = Eigen::Vector2f::Zero();
  for (const Wave& wave : waves_) {
    shift += wave.shift_m *
             sineOfTurns(wave.turns_at_origin + wave.turns_per_m.x() * u_m + wave.turns_per_m.y() * v_m);
  }
  return shift;
}

}  // namespace redbee::simulation
