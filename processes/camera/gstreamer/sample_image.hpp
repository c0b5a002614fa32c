// Messages from what an appsink gives.
#pragma once

#include <gst/gst.h>

#include <optional>

#include "redbee/image_t.hpp"

namespace redbee {

/// JPEG as it comes, or rows without padding of GRAY8, RGB or BGR; without a time. std::nullopt where the
/// buffer cannot be read.
std::optional<image_t> imageOf(GstSample* sample);

}  // namespace redbee
