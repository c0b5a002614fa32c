// What a pipeline says of its failure, in one line for PROCESS_HEALTH.
#pragma once

#include <gst/gst.h>

#include <string>

namespace redbee {

/// Of a message of an error: element, place (file, device, address), error. The same failure gives the same
/// line, however often the pipeline was built again; what may be a password of an address stays out.
std::string faultOf(GstMessage* message);
/// Of a description that is no pipeline here; names the package of an element that is missing.
std::string faultOf(const GError& error);

}  // namespace redbee
