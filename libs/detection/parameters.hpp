// The tunables of detection, a struct for each part. The configuration file has the same names, in the groups
// of `detection`.
#pragma once

#include <string>

namespace redbee {

/// Motion from dense flow against the camera's motion: flow between a frame and an earlier one, after the
/// ground's (and above the horizon the rotation's) motion has been taken out. libs/README.md, "Parallax".
struct ParallaxParameters {
  int work_downscale = 2;  ///< 1, 2 or 4: all of it on an image this much smaller
  /// 1, 2 or 4: the flow on an image this much smaller than the camera's, never larger than work_downscale
  /// makes it: its patches of 8 px are to be no larger than the smallest mover.
  int flow_downscale = 2;
  double baseline_s =
      0.083;  ///< s: to the reference frame; longer shows slower objects and makes the flow harder
  bool use_short_baseline =
      true;                   ///< use the previous frame as reference while large, fast objects are in view
  bool use_epipolar = true;   ///< accept as static any flow that some depth explains, not the ground's alone
  double noise_px = 0.5;      ///< px, one sigma of the flow over good texture, at the full-size image
  double min_gradient = 1.6;  ///< grey levels a px, of an image four times smaller: texture at which the
                              ///< flow's variance doubles
  double direction_error = 0.05;  ///< rad, one sigma of the direction of travel; scales with the parallax
  double nearest_depth_fraction =
      0.15;                      ///< of the height: no static surface is nearer to the camera than this
  double evidence_sigmas = 2.5;  ///< distance from the parallax segment, in sigmas, that is half the evidence
  double evidence_rate = 0.2;  ///< learning rate of the evidence propagated along the flow; 1: no propagation
  bool use_registration =
      true;  ///< estimate and remove the residual homography error before testing for motion
  bool use_static_match =
      true;  ///< compare the images along the parallax segment where the flow says that something moves
  /// Of the image's width: without an IMU, evidence connected to so long a stretch of the image's border
  /// belongs to a static structure; 0: off.
  double border_stretch = 0.05;
  double motion_half = 0.15;     ///< evidence of motion that gives half of P_FG
  double fill_radius_px = 6;     ///< px: reach of the edge-aware filter on the motion
  double fill_contrast = 12;     ///< grey levels: the filter smooths over lower contrast
  bool use_hole_filling = true;  ///< fill regions inside an object that resemble the background
  double outline_gap_px = 4;     ///< px: gaps in an outline up to this are closed before its hole is filled
  double region_radius_px = 8;   ///< px: reach of the same filter on P_FG, for half of it; 0: none
};

/// The appearance difference to the background, which the parallax's evidence is multiplied by.
struct AppearanceParameters {
  bool enabled = true;           ///< false: P_FG from motion alone
  int downscale = 2;             ///< 1, 2 or 4: the background model is on an image this much smaller
  double span_s = 0.5;           ///< s: over which it is averaged
  double noise = 20.0;           ///< grey levels: differences of this size are noise
  double edge_tolerance_px = 3;  ///< px: tolerance for misaligned edges of the background
  bool use_surface_reset =
      true;  ///< reset the background where the surface it was learned from has moved away
};

/// Cast shadows, excluded from the appearance difference.
struct ShadowParameters {
  bool enabled = true;  ///< exclude cast shadows from the foreground
  double noise = 8;     ///< grey levels: residual of a shadow after scaling its brightness
};

/// Foreground refinement (paper III.B), equations (12) to (16).
struct RefinementParameters {
  bool enabled = false;         ///< false: P_FG is the raw foreground
  bool use_entropy = true;      ///< multiply by the entropy term P_E (15)
  double alpha = 0.4;           ///< temporal learning rate (13)
  double beta = 0.4;            ///< spatial learning rate (14)
  double gamma = 0.6;           ///< entropy learning rate (15)
  int spatial_window_px = 9;    ///< px, odd: side w of the neighbourhood in (14)
  int entropy_cell_points = 4;  ///< sample points to a side of an entropy cell (12)
  int entropy_bins = 12;        ///< directions (12)
  double entropy_floor = 1.0;   ///< bits: floor / max(entropy, floor), so that P_E is 0..1 and two directions
                                ///< are still order
  double flow_noise_px = 0.4;   ///< px: flow below this has no direction and does not vote
};

/// Masks and tracks: the last stage of every detector.
struct ObjectParameters {
  double threshold = 0.6;         ///< on P_FG: somewhere an object exceeds it
  double extent_threshold = 0.4;  ///< on P_FG: an object reaches as far as it exceeds this; at most threshold
  int opening_px = 3;             ///< px: diameter of the disc that removes specks; 0: none
  int closing_px = 7;             ///< px: diameter of the disc that closes holes; 0: none
  double min_area_px = 30;        ///< px^2: smaller components are no objects
  int max_missed_frames =
      24;                  ///< frames a track survives without a component; as many again that are skipped
  int confirm_frames = 2;  ///< frames before a track is confirmed
};

/// The paper's background (III.A): a mixture of Gaussians per pixel (Zivkovic) for each plane.
struct TwoPlaneParameters {
  int mixture_history = 500;  ///< frames that the mixture remembers
  double mixture_threshold =
      16.0;                     ///< squared Mahalanobis distance beyond which a pixel is not its background
  double canvas_margin = 0.0;   ///< fraction of the image's width: border of the canvas that a model is kept
                                ///< on; 0: the model is carried along, into every new frame
  bool use_front_plane = true;  ///< model the front plane's background beside the ground's
};

struct DetectionParameters {
  std::string method = "parallax";  ///< one of detectorNames()
  int learning_frames = 5;          ///< frames before the first mask
  double min_contrast = 2.0;  ///< grey levels: standard deviation below which an image is black or blank
  ParallaxParameters parallax;
  AppearanceParameters appearance;
  ShadowParameters shadow;
  RefinementParameters refinement;
  ObjectParameters objects;
  TwoPlaneParameters two_planes;
};

/// The paper's own configuration; the default is ours.
DetectionParameters paperDetection();

}  // namespace redbee
