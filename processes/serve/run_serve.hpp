// main() of redbee-serve.
#pragma once

namespace redbee {

/// Returns what runProcess() does.
int runServe(int argc, char** argv);

}  // namespace redbee
