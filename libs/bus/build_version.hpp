// Release and commit of this build.
#pragma once

namespace redbee {

/// "0.2.0".
const char* releaseVersion();

/// Release and commit, "0.2.0+7a7631e21c"; ".changed" is appended if the sources had uncommitted changes.
const char* buildVersion();

}  // namespace redbee
