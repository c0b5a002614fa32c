// Every tunable of the segmentation, with its meaning. The configuration file has the same names.
#pragma once

namespace redbee {

/// Where the raw foreground comes from.
enum class SegmentationMethod {
  kTwoPlanes,  ///< the paper: a mixture of Gaussians behind each plane, foreground is what neither explains
  kParallax,   ///< dense flow against the camera's motion: foreground is what no depth explains
};

struct SegmentationParameters {
  SegmentationMethod method = SegmentationMethod::kParallax;

  // Background (paper III.A): a mixture of Gaussians per pixel (Zivkovic) for each plane.
  int mixture_history = 500;  ///< frames that the mixture remembers
  double mixture_threshold =
      16.0;                     ///< squared Mahalanobis distance beyond which a pixel is not its background
  double canvas_margin = 0.0;   ///< share of the picture's width: border of the canvas that a model is kept
                                ///< on; 0: the model is carried along, into every new frame
  int learning_frames = 5;      ///< frames before the first mask
  bool use_front_plane = true;  ///< false: Table II's "without front plane"

  // Parallax: flow between a frame and an earlier one, after the ground's (and above the horizon the
  // rotation's) motion has been taken out.
  double baseline_s = 0.125;  ///< s: how much earlier; longer shows slower movers and asks more of the flow
  int flow_downscale = 1;     ///< 1, 2 or 4: flow on a picture this much smaller
  bool use_epipolar = true;   ///< false: any flow against the ground homography is foreground
  double parallax_noise_px = 0.5;     ///< px, one sigma of the flow at a full-size picture
  double direction_error = 0.05;      ///< rad, one sigma of the direction of travel; scales with the parallax
  double nearest_depth_share = 0.15;  ///< of the height: no static surface is nearer to the camera than this
  double evidence_sigmas = 3.0;  ///< distance from the parallax segment, in sigmas, that is half the evidence
  bool use_photometric = true;   ///< false: the flow alone, without comparing grey values
  double photometric_noise = 6.0;  ///< grey levels: differences of this size are noise
  int photometric_window_px = 7;  ///< px, odd: does moving freely fit the picture better than standing still?
  int silhouette_window_px = 3;   ///< px, odd: does standing still fit it at all?
  double evidence_rate =
      0.15;  ///< learning rate of the evidence that travels along the flow; 1: none travels

  // Foreground refinement (paper III.B).
  bool use_refinement = true;   ///< false: Table II's "without refinement": P_FG is the raw foreground
  bool use_entropy = true;      ///< the entropy term P_E alone
  double alpha = 0.4;           ///< temporal learning rate (13)
  double beta = 0.4;            ///< spatial learning rate (14)
  double gamma = 0.6;           ///< entropy learning rate (15)
  int spatial_window_px = 9;    ///< px, odd: side w of the neighbourhood in (14)
  int sample_grid_px = 16;      ///< px between the sample points of the tracks
  int entropy_cell_points = 4;  ///< sample points to a side of an entropy cell (12)
  int entropy_bins = 12;        ///< directions (12)
  double entropy_floor =
      1.0;  ///< bits: floor / max(entropy, floor), so that P_E is 0..1 and two directions are still order
  double flow_noise_px = 0.4;  ///< px: flow below this has no direction and does not vote

  // Masks and objects.
  double threshold = 0.15;     ///< on P_FG
  int opening_px = 3;          ///< px: 0 for none
  int closing_px = 7;          ///< px: 0 for none
  double min_area_px = 30;     ///< px^2: smaller components are no objects
  int max_missed_frames = 24;  ///< frames an identity survives unseen
  int confirm_frames = 2;      ///< frames an object must stand out in before it is told

  // Pictures that nothing can be learned from.
  double min_contrast = 2.0;  ///< grey levels: standard deviation below which a picture is black or blank
};

/// The paper's own configuration; the default is ours.
SegmentationParameters paperSegmentation();

}  // namespace redbee
