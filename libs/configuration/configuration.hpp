// One vehicle's configuration: the validated content of its YAML file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "redbee/detection/parameters.hpp"
#include "redbee/files/user_error.hpp"
#include "redbee/fusion/homography_fusion.hpp"
#include "redbee/geolocation/parameters.hpp"
#include "redbee/geometry/camera.hpp"
#include "redbee/inertial/inertial_filter.hpp"
#include "redbee/mavlink/parameters.hpp"
#include "redbee/visual/front_plane_estimator.hpp"
#include "redbee/visual/visual_homography.hpp"

namespace redbee {

struct Channels {
  std::string camera = "CAMERA";
  std::string imu = "IMU";
  std::string altimeter = "ALTIMETER";
  std::string inertial_homography = "INERTIAL_HOMOGRAPHY";
  std::string filter_snapshot = "FILTER_SNAPSHOT";
  std::string warm_start = "WARM_START";
  std::string visual_homography = "VISUAL_HOMOGRAPHY";
  std::string fused_homography = "FUSED_HOMOGRAPHY";
  std::string foreground = "FOREGROUND";
  std::string detections = "DETECTIONS";
  std::string overlay = "OVERLAY";
  std::string health = "PROCESS_HEALTH";
  std::string pose = "POSE";
  std::string gimbal = "GIMBAL";
  std::string lens = "LENS";
  std::string autopilot_clock = "AUTOPILOT_CLOCK";
  std::string targets = "TARGETS";
};

/// Timeouts, in message time, of each process for the companions of a frame. A process that waits for another
/// one which waits itself needs the longer timeout; otherwise the failure of one process makes both time out.
/// Checked against the process table when a configuration is loaded. A process that is slower than the camera
/// falls behind by at most as much.
struct WaitParameters {
  double inertial_s = 0.25;      ///< s, for the fused homography of the previous frame
  double visual_s = 0.25;        ///< s, for the inertial homography
  double fusion_s = 0.3;         ///< s, for either homography
  double segmentation_s = 0.45;  ///< s, for the fused homography
};

/// For `redbee watch`.
struct WatchParameters {
  double hang_timeout_s = 2.0;  ///< s of wall time without a sign of life, after which a process is killed
};

/// For redbee-camera. Its images have the size of the section `camera`.
struct CaptureParameters {
  std::string pipeline;  ///< of GStreamer, with one appsink; empty: none
  double rate_hz = 0;    ///< Hz, expected; fewer images are reported; 0: any
  int jpeg_quality = 0;  ///< of images that the pipeline gives raw; 0: they stay raw
  /// What the driver stamps an image with: "middle" of its exposure, or nothing that is known;
  /// "exposure_start" of the first row, "readout_end" of the last: its middle follows from the exposure time.
  std::string stamp = "middle";
  double exposure_s = 0;  ///< s, where the driver does not tell it; 0: unknown
};

/// For redbee-serve, the ground station in the browser.
struct ServeParameters {
  std::string listen;         ///< see listen_address.hpp; empty: it does not fly
  std::string token_file;     ///< of what a browser must know; may be empty where `listen` is local
  bool allow_writes = false;  ///< the page may start and stop the recorder and restart processes
};

struct Configuration {
  std::string vehicle = "unnamed";
  CameraIntrinsics camera;
  std::string mask;           ///< image file of the vehicle's own parts in the camera's images; empty: none
  cv::Mat1b own_parts;        ///< its content when it was loaded: 255 where it is 128 or brighter, else 0
  bool has_imu = true;        ///< false: vision only, no process waits for the IMU
  bool has_altimeter = true;  ///< false: altimeter messages are ignored
  InertialParameters inertial;
  VisualParameters visual;
  FrontPlaneParameters front;
  FusionParameters fusion;
  DetectionParameters detection;
  Channels channels;
  WaitParameters waits;
  WatchParameters watch;
  CaptureParameters capture;
  AutopilotParameters autopilot;
  ServeParameters serve;
  GeolocationParameters geolocation;
  GroundLinkParameters ground_link;
  int overlay_period_frames = 4;  ///< OVERLAY is published for every n-th frame; 0: never

  /// Whether INERTIAL_HOMOGRAPHY comes for each frame: of the IMU, or at least with the lens' focal length.
  bool expectsInertial() const { return has_imu || inertial.lens.enabled; }
};

/// what() is one line: `file:line: key: what is wrong`.
class ConfigurationError : public UserError {
 public:
  using UserError::UserError;
};

/// Reads a vehicle file. Keys that it does not set keep the values of the included files, otherwise the
/// defaults above.
///   include: FILE or [FILE, ...]   relative to the including file; read first, so the including file wins
///   preset: default | paper | vision_only   overrides included files and is overridden by its own file's
///   keys
/// Throws ConfigurationError on the first error: unknown, renamed or duplicate keys, wrong types, invalid
/// values, a missing camera, duplicate channel names, an unusable camera.mask, timeouts in the wrong order,
/// an extent threshold above its threshold, circular includes.
Configuration loadConfiguration(const std::filesystem::path& file);

/// Overrides from the command line; the preset is applied first.
struct ConfigurationOverrides {
  std::string preset;                 ///< empty: none
  std::vector<std::string> settings;  ///< KEY=VALUE, e.g. `detection.objects.threshold=0.5`
};
/// The same with overrides.
Configuration loadConfiguration(const std::filesystem::path& file, const ConfigurationOverrides& overrides);

/// In alphabetical order.
std::vector<std::string> presetNames();

/// The whole configuration as YAML; loading it gives the same hash.
std::string emitYaml(const Configuration& configuration);
/// Only these keys, in the same order; for files that others include. Throws std::invalid_argument for an
/// unknown key.
std::string emitYaml(const Configuration& configuration, const std::vector<std::string>& keys);

/// 16 hexadecimal digits (FNV-1a of emitYaml()): equal for equal values, however the files are written.
std::string configurationHash(const Configuration& configuration);

/// All keys that a file may have (such as `camera.fx`), in the order of emitYaml(); without `include` and
/// `preset`.
std::vector<std::string> configurationKeys();

}  // namespace redbee
