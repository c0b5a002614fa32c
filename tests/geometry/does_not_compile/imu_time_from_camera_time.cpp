#include "redbee/geometry/time.hpp"

redbee::ImuTime exposure(redbee::CameraTime frame) {
#ifdef REDBEE_CORRECT
  return toImu(frame, redbee::Duration(1000));
#else
  return frame;
#endif
}
