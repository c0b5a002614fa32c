#include "redbee/geometry/time.hpp"

bool isLater(redbee::CameraTime frame, redbee::ImuTime sample) {
#ifdef REDBEE_CORRECT
  return toImu(frame, redbee::Duration(0)) < sample;
#else
  return frame < sample;
#endif
}
