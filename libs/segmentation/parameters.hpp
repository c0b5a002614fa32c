// Every tunable of the segmentation, with its meaning. The configuration file has the same names.
#pragma once

namespace redbee {

struct SegmentationParameters {
  // Background (paper III.A): a mixture of Gaussians per pixel (Zivkovic) for each plane.
  int mixture_history = 60;            ///< frames that the mixture remembers
  double mixture_threshold = 16.0;     ///< squared Mahalanobis distance beyond which a pixel is not its background
  int learning_frames = 5;             ///< frames before the first mask
  bool use_front_plane = true;         ///< false: Table II's "without front plane"

  // Foreground refinement (paper III.B).
  bool use_refinement = true;          ///< false: Table II's "without refinement": P_FG is the raw foreground
  bool use_entropy = true;             ///< the entropy term P_E alone
  double alpha = 0.4;                  ///< temporal learning rate (13)
  double beta = 0.4;                   ///< spatial learning rate (14)
  double gamma = 0.6;                  ///< entropy learning rate (15)
  int spatial_window_px = 9;           ///< px, odd: side w of the neighbourhood in (14)
  int entropy_cell_points = 4;         ///< sample points to a side of an entropy cell (12)
  int entropy_bins = 12;               ///< directions (12)
  double entropy_floor = 0.25;         ///< bits: 1 / max(entropy, floor), times the floor, so that P_E is 0..1
  double flow_noise_px = 0.4;          ///< px: flow below this has no direction and does not vote

  // Masks and objects.
  double threshold = 0.15;             ///< on P_FG
  int opening_px = 3;                  ///< px: 0 for none
  int closing_px = 7;                  ///< px: 0 for none
  double min_area_px = 30;             ///< px^2: smaller components are no objects
  int max_missed_frames = 24;          ///< frames an identity survives unseen
};

}  // namespace redbee
