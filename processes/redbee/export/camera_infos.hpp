// The camera's parameters at each image of a log.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "redbee/configuration/configuration.hpp"
#include "redbee/image_t.hpp"
#include "redbee/inertial/lens_track.hpp"
#include "redbee/lens_t.hpp"

namespace redbee {

/// Where the lens zooms, each image has its own focal length, which LENS says a little later: it is written
/// then, and at the latest with the image a second later.
class CameraInfos {
 public:
  using Write = std::function<void(const std::string& topic, int64_t utime, const CameraIntrinsics& camera)>;
  CameraInfos(const Configuration& configuration, Write write);

  /// Of the log; those of another size than the camera's are passed over.
  void add(const std::string& topic, const image_t& image);
  void add(const lens_t& message);
  /// At the log's end.
  void finish();

 private:
  struct Pending {
    std::string topic;
    int64_t utime;
  };
  ImuTime imuTimeOf(int64_t utime) const;
  bool isDue(int64_t utime) const;
  void writeFront();

  Configuration configuration_;
  Write write_;
  std::optional<LensTrack> lens_;
  std::deque<Pending> pending_;
};

}  // namespace redbee
