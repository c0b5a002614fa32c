// What a vehicle file says of a lens that zooms: the section `lens`.
#pragma once

namespace redbee {

struct LensParameters {
  /// True: LENS says the focal length of each frame. False: it is the configured one.
  bool enabled = false;
  /// px, what LENS states, in an image of the camera's width, where camera.fx holds; 0: camera.fx itself. A
  /// maker's number is not the calibrated one, but in proportion to it.
  double focal_length_px = 0;
  /// The longest focal length over the shortest, which camera.fx is of then: where LENS states the place in
  /// the zoom's range alone, or a focal length with it that focal_length_px does not say what to compare
  /// with. 0: such a message is of no use.
  double zoom_range = 0;
  double focal_sigma = 0.001;  ///< of the focal length, one standard deviation over it, anew in each frame
  /// True: LENS is stamped as the images are, as an import's is: camera.timeshift_s applies to it, too.
  bool on_camera_clock = false;
  double timeshift_s = 0;   ///< s, the lens was where it says at its message's time + timeshift
  double max_gap_s = 0.25;  ///< s between two messages: in a longer gap the focal length is not known
};

}  // namespace redbee
