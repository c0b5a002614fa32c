// Every tunable of the segmentation. The configuration file has the same names.
#pragma once

namespace redbee {

/// Where the raw foreground comes from.
enum class SegmentationMethod {
  kTwoPlanes,  ///< the paper: a mixture of Gaussians for each plane; foreground is what neither explains
  kParallax,   ///< dense flow against the camera's motion: foreground is what no depth explains
};

struct SegmentationParameters {
  SegmentationMethod method = SegmentationMethod::kParallax;

  // Background (paper III.A): a mixture of Gaussians per pixel (Zivkovic) for each plane.
  int mixture_history = 500;  ///< frames that the mixture remembers
  double mixture_threshold =
      16.0;                     ///< squared Mahalanobis distance beyond which a pixel is not its background
  double canvas_margin = 0.0;   ///< fraction of the image's width: border of the canvas that a model is kept
                                ///< on; 0: the model is carried along, into every new frame
  int learning_frames = 5;      ///< frames before the first mask
  bool use_front_plane = true;  ///< false: Table II's "without front plane"

  // Parallax: flow between a frame and an earlier one, after the ground's (and above the horizon the
  // rotation's) motion has been taken out, times the appearance difference to the background.
  int work_downscale = 2;  ///< 1, 2 or 4: all of it on an image this much smaller
  /// 1, 2 or 4: the flow on an image this much smaller than the camera's, never larger than work_downscale
  /// makes it: its patches of 8 px are to be no larger than the smallest mover.
  int flow_downscale = 2;
  double baseline_s =
      0.083;  ///< s: to the reference frame; longer shows slower objects and makes the flow harder
  bool use_short_baseline =
      true;                  ///< use the previous frame as reference while large, fast objects are in view
  bool use_epipolar = true;  ///< false: any flow that the ground homography does not explain is foreground
  double parallax_noise_px = 0.5;  ///< px, one sigma of the flow over good texture, at the full-size image
  double min_gradient = 1.6;       ///< grey levels a px, of an image four times smaller: texture at which the
                                   ///< flow's variance doubles
  double direction_error = 0.05;   ///< rad, one sigma of the direction of travel; scales with the parallax
  double nearest_depth_fraction =
      0.15;                      ///< of the height: no static surface is nearer to the camera than this
  double evidence_sigmas = 2.5;  ///< distance from the parallax segment, in sigmas, that is half the evidence
  double evidence_rate =
      0.2;  ///< learning rate of the evidence that is propagated along the flow; 1: no propagation
  bool use_registration =
      true;  ///< estimate and remove the residual homography error before testing for motion
  /// Of the image's width: without an IMU, evidence connected to so long a stretch of the image's border
  /// belongs to a static structure; 0: off.
  double border_stretch = 0.05;
  double motion_half = 0.15;       ///< evidence of motion that gives half of P_FG
  bool use_appearance = true;      ///< false: motion alone, without the appearance difference
  int background_downscale = 2;    ///< 1, 2 or 4: the background model is on an image this much smaller
  double background_span_s = 0.5;  ///< s: over which it is averaged
  double background_noise = 20.0;  ///< grey levels: differences of this size are noise
  double edge_doubt_px = 3;        ///< px: tolerance for misaligned edges of the background
  bool use_surfaces = true;     ///< reset the background where the surface it was learned from has moved away
  bool use_shadow_test = true;  ///< exclude cast shadows from the foreground
  double shadow_noise = 8;      ///< grey levels: residual of a shadow after scaling its brightness
  double fill_radius_px = 6;    ///< px: reach of the edge-aware filter on the motion
  double fill_contrast = 12;    ///< grey levels: the filter smooths over lower contrast
  bool use_hole_filling = true;  ///< fill regions inside an object that resemble the background
  double outline_gap_px = 4;     ///< px: gaps in an outline up to this are closed before its hole is filled
  double region_radius_px = 8;   ///< px: reach of the same filter on P_FG, for half of it; 0: none

  // Foreground refinement (paper III.B).
  bool use_refinement = false;  ///< (13) to (16); false: P_FG is the raw foreground
  bool use_entropy = true;      ///< the entropy term P_E alone
  double alpha = 0.4;           ///< temporal learning rate (13)
  double beta = 0.4;            ///< spatial learning rate (14)
  double gamma = 0.6;           ///< entropy learning rate (15)
  int spatial_window_px = 9;    ///< px, odd: side w of the neighbourhood in (14)
  int sample_grid_px = 24;      ///< px between the sample points of the tracks
  int entropy_cell_points = 4;  ///< sample points to a side of an entropy cell (12)
  int entropy_bins = 12;        ///< directions (12)
  double entropy_floor =
      1.0;  ///< bits: floor / max(entropy, floor), so that P_E is 0..1 and two directions are still order
  double flow_noise_px = 0.4;  ///< px: flow below this has no direction and does not vote

  // Masks and objects.
  double threshold = 0.6;         ///< on P_FG: somewhere an object exceeds it
  double extent_threshold = 0.4;  ///< on P_FG: an object reaches as far as it exceeds this
  int opening_px = 3;             ///< px: 0 for none
  int closing_px = 7;             ///< px: 0 for none
  double min_area_px = 30;        ///< px^2: smaller components are no objects
  int max_missed_frames =
      24;                  ///< frames a track survives without a component; as many again that are skipped
  int confirm_frames = 2;  ///< frames before a track is confirmed

  // Images that are not learned from.
  double min_contrast = 2.0;  ///< grey levels: standard deviation below which an image is black or blank
};

/// The paper's own configuration; the default is ours.
SegmentationParameters paperSegmentation();

}  // namespace redbee
