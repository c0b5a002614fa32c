// The parameters of detection, one struct for each part; the configuration file has the same names below
// `detection`.
#pragma once

#include <string>

namespace redbee {

/// Evidence of motion from dense flow between a frame and an earlier one, compensated by the ground
/// homography (above the horizon by the rotation). libs/README.md, "Parallax".
struct ParallaxParameters {
  int work_downscale = 2;  ///< 1, 2 or 4: downscaling of the image that all of this is computed on
  /// 1, 2 or 4: downscaling of the image that the flow is computed on; effectively at least work_downscale.
  /// Patches of 8 px should be no larger than the smallest moving object.
  int flow_downscale = 2;
  double baseline_s =
      0.083;  ///< s: to the reference frame; a longer one detects slower objects, with more difficult flow
  bool use_short_baseline =
      true;                  ///< use the previous frame as reference while large, fast objects are in view
  bool use_epipolar = true;  ///< accept flow along the epipolar line as static, not only that of the ground
  bool use_epipole = true;   ///< without an IMU, estimate the epipole from the flow
  double noise_px = 0.5;     ///< px at full size, one sigma of the flow over good texture
  double min_gradient = 8;   ///< grey levels per px, in an image four times smaller: gradient at which the
                             ///< variance of the flow along it doubles
  /// Grey levels, noise of the difference of two images: components count more where their flow explains the
  /// image better than static surfaces do, less where it does not; 0: off.
  double photometric_noise = 10;
  double direction_error = 0.05;  ///< rad, one sigma of the direction of travel; scales with the parallax
  double nearest_depth_fraction =
      0.15;                      ///< of the height: no static surface is nearer to the camera than this
  double evidence_sigmas = 2.5;  ///< distance from the parallax segment [sigmas] at which the evidence is 1/2
  double evidence_rate = 0.2;  ///< learning rate of the evidence propagated along the flow; 1: no propagation
  /// With an IMU and where no candidates are looked for: follow points for a second, for small and slow
  /// objects.
  bool use_point_paths = true;
  bool use_registration =
      true;  ///< estimate and remove the residual homography error before testing for motion
  /// Fraction of the image's width: without an IMU, evidence connected to a stretch of the border at least
  /// this long belongs to a static structure; 0: off.
  double border_stretch = 0.05;
  double motion_half = 0.15;     ///< evidence of motion at which P_FG is half of the appearance difference
  double fill_radius_px = 6;     ///< px: radius of the edge-aware filter on the evidence
  double fill_contrast = 12;     ///< grey levels: the filter smooths over lower contrast
  bool use_hole_filling = true;  ///< fill regions inside an object that resemble the background
  double outline_gap_px = 4;     ///< px: larger gaps in an outline are not closed
  double region_radius_px = 8;   ///< px: radius of the same filter on P_FG, which it is averaged with; 0: off
};

/// The appearance difference to the background, combined with the evidence of motion.
struct AppearanceParameters {
  bool enabled = true;           ///< false: P_FG from motion alone
  int downscale = 2;             ///< 1, 2 or 4: downscaling of the background model
  double span_s = 0.5;           ///< s: averaging time of the model
  double noise = 20.0;           ///< grey levels: noise sigma of the difference
  double edge_tolerance_px = 3;  ///< px: tolerance for misaligned edges of the background
  /// Components are regions of the difference of appearance that boosted trees judge; false: of P_FG. Only
  /// where `downscale` is the flow's work_downscale.
  bool use_candidates = true;
  bool use_surface_reset = true;  ///< reset the model where the surface it was learned from has moved away
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
  int entropy_cell_points = 4;  ///< sample points per side of an entropy cell (12)
  int entropy_bins = 12;        ///< directions (12)
  double entropy_floor = 1.0;   ///< bits: P_E = floor / max(entropy, floor); 1 bit is two directions
  double flow_noise_px = 0.4;   ///< px: flow below this has no direction and does not vote
};

/// Masks and tracks: the last stage of every detector.
struct ObjectParameters {
  /// On P_FG: components that exceed this somewhere are strong, and are assigned to tracks first.
  double threshold = 0.6;
  double weak_threshold = 0.4;  ///< on P_FG, at most `threshold`: components count that exceed this somewhere
  double neutral = 0.55;  ///< P_FG of a component that, alone, is evidence neither for nor against its track
  double extent_threshold = 0.12;  ///< on P_FG, at most `threshold`: components reach no further than this
  int opening_px = 3;              ///< px: diameter of the disc that removes specks; 0: none
  int closing_px = 7;              ///< px: diameter of the disc that closes holes; 0: none
  double min_area_px = 30;         ///< px^2: smaller components are discarded
  double max_missed_s = 2;  ///< s that a track survives without a component, and likewise of skipped frames
  /// s: a track is confirmed by components whose log odds (of P_FG and gain) are above neutral by 1 for as
  /// long, surer ones sooner; 0: at once.
  double confirm_s = 0.15;
};

/// For a method that decides by one threshold on P_FG: objects reach as far as it does, and whatever it
/// decides, and half of it, is evidence for a track.
void decideAt(double threshold, ObjectParameters& parameters);

/// The paper's background (III.A): a mixture of Gaussians per pixel (Zivkovic) for each plane.
struct TwoPlaneParameters {
  int mixture_history = 500;        ///< frames; inverse of the learning rate
  double mixture_threshold = 16.0;  ///< squared Mahalanobis distance beyond which a pixel is foreground
  double canvas_margin = 0.0;       ///< fraction of the image's width: margin of the canvas that the model is
                                    ///< stored on; 0: the model is warped into every frame
  bool use_front_plane = true;      ///< model the front plane's background beside the ground's
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

/// The paper's configuration.
DetectionParameters paperDetection();

}  // namespace redbee
