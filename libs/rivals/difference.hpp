// The absolute difference to the previous picture, laid onto this one by a homography: the simplest of all.
//
// Nobody's publication. Score: kDecisionScore at 20 grey levels.
#pragma once

#include "rivals/registration.hpp"
#include "rivals/rival.hpp"

namespace redbee {

class Difference : public Rival {
 private:
  void reset() override;
  RivalOutput judge(const RivalInput& input) override;

  Registrar registrar_;
  cv::Mat previous_;
};

}  // namespace redbee
