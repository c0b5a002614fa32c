// Evidence that a track's component is an object: the terms of (35), libs/README.md.
#pragma once

namespace redbee {

/// Of P_FG, 0..1; bounded by those of 0.05 and 0.95, as the next.
double logOdds(double probability);
/// Of ForegroundMaps::gain: a ratio of two squares, as the odds of (29) are.
double gainLogOdds(double gain);
/// Of Component::residual_around: where all that surrounds it moves unlike a static surface, as water does,
/// so may the component. The residual's length counts, in units of its sigma; at most 0.
double restlessLogOdds(double squared_residual);
/// Of a track of this age [s] that has moved `farthest` from its origin, in roots of its box's area. What has
/// not left its place sways or is static: at most 0.
double stayedLogOdds(double age_s, double farthest);
/// Of a track of this age [s] whose path has this log likelihood ratio (static_path.hpp), instead, where the
/// camera's motion is known. The first half second may only count for it.
double movingLogOdds(double age_s, double log_likelihood_ratio);

}  // namespace redbee
