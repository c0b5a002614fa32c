#include "redbee/geometry/time.hpp"

redbee::CameraTime exposure(int64_t utime) {
#ifdef REDBEE_CORRECT
  return redbee::CameraTime(redbee::fromUtime(utime));
#else
  return utime;
#endif
}
