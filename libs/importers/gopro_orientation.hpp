// How a GoPro turned its images electronically, from the packets of its GPMF track.
#pragma once

#include <optional>
#include <vector>

#include "redbee/importers/data_track.hpp"
#include "redbee/importers/gopro_imu.hpp"
#include "redbee/inertial/mount_track.hpp"

namespace redbee {

/// The images' rotation against the camera, one of each frame, at the frame's time on the video's clock: that
/// of a mount whose axes are the IMU's at rest (GoproStreams). Without IORI empty.
///
/// Axes: CORI holds the camera's and IORI the image's orientation, each as the rotation that turns the
/// world's or the camera's coordinates into its own, w first, then right, down, forward. Derived from a
/// recording of a MAX: of all orders and signs these leave 0.015 degrees between CORI's steps and the gyro's,
/// and IORI CORI, alone among the products, is smooth (0.02 degrees a frame, CORI itself 0.22) and turns as
/// the images do.
///
/// Throws GpmfError if a payload is damaged.
std::vector<MountSample> imageTurns(const std::vector<DataPacket>& packets);

/// Degrees between the images that are turned the furthest apart from the first one.
double largestTurn_deg(const std::vector<MountSample>& turns);

/// s by which the gyro's time of an exposure lies after the frame's on the video's clock (as
/// camera.timeshift_s), from CORI, which the camera integrated from the same gyro. std::nullopt where there
/// is none, where the camera did not turn, or where nothing within a tenth of a second fits. Throws
/// GpmfError.
std::optional<double> frameLag(const std::vector<DataPacket>& packets, const GoproStreams& streams);

}  // namespace redbee
