// Evidence that what a track is found as is an object: the terms of (34), libs/README.md.
#pragma once

namespace redbee {

/// Of P_FG, 0..1.
double logOdds(double probability);
/// Of ForegroundMaps::gain: a ratio of two squares, as the odds of (29) are.
double gainLogOdds(double gain);
/// Of a track of this age [s] that has moved `farthest` from its origin, in roots of its box's area. What has
/// not left its place sways or is static: at most 0.
double stayedLogOdds(double age_s, double farthest);

}  // namespace redbee
