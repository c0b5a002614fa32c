#include "redbee/geometry/time.hpp"

redbee::ImuTime exposure(redbee::CameraTime frame, redbee::Duration timeshift) {
#ifdef REDBEE_CORRECT
  return toImu(frame, timeshift);
#else
  return toImu(toImu(frame, timeshift), timeshift);
#endif
}
