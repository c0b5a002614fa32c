// Which build this is.
#pragma once

namespace redbee {

/// "0.2.0".
const char* releaseVersion();

/// Release and commit, "0.2.0+7a7631e21c"; ".changed" behind it where the sources were not as committed.
const char* buildVersion();

}  // namespace redbee
