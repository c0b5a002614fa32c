#include "redbee/bus/build_version.hpp"

#include "build_version_text.hpp"

namespace redbee {

const char* releaseVersion() { return REDBEE_RELEASE; }

const char* buildVersion() { return REDBEE_BUILD_VERSION; }

}  // namespace redbee
