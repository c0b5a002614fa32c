#include "redbee/geometry/time.hpp"

redbee::Duration between(redbee::CameraTime frame, redbee::ImuTime sample) {
#ifdef REDBEE_CORRECT
  return frame - toCamera(sample, redbee::Duration(0));
#else
  return frame - sample;
#endif
}
