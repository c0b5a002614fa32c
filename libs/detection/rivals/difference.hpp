// The absolute difference to the image before the previous one, aligned to this one by homographies: the
// simplest detector. Not from a publication. The difference is averaged over a box, which fills holes and
// removes speckles. Box, smoothing, frame distance and threshold are tuned (EXPERIMENTS.md). Score:
// kDecisionScore at 20 grey levels.
//
// `difference-davis` has the best setting on DAVIS' clips alone, whose objects are large and fast.
#pragma once

#include "redbee/detection/rivals/image_history.hpp"
#include "redbee/detection/rivals/registration.hpp"
#include "redbee/detection/rivals/rival.hpp"

namespace redbee {

struct DifferenceParameters {
  size_t back_frames = 2;
  int average_px = 15;  ///< side of the box
};

class Difference : public Rival {
 public:
  explicit Difference(const ObjectParameters& objects, const DifferenceParameters& parameters = {});

 private:
  void reset() override;
  RivalScore scoreFrame(const FrameInput& input) override;

  DifferenceParameters parameters_;
  Registrar registrar_;
  ImageHistory history_;
};

}  // namespace redbee
