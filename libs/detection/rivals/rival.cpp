#include "redbee/detection/rivals/rival.hpp"

#include <map>

#include "redbee/detection/rivals/aurora.hpp"
#include "redbee/detection/rivals/datmo.hpp"
#include "redbee/detection/rivals/difference.hpp"
#include "redbee/detection/rivals/flow_residual.hpp"
#include "redbee/detection/rivals/homography_mog2.hpp"
#include "redbee/detection/rivals/mcd.hpp"
#include "redbee/detection/rivals/meier.hpp"
#include "redbee/detection/rivals/trajectory_rival.hpp"

namespace redbee {
namespace {

using Factory = std::unique_ptr<Rival> (*)();

template <typename Kind>
std::unique_ptr<Rival> make() {
  return std::make_unique<Kind>();
}

template <typename Kind, typename Parameters>
std::unique_ptr<Rival> makeWith(const Parameters& parameters) {
  return std::make_unique<Kind>(parameters);
}

/// Forgets sooner.
AuroraParameters auroraOnDavis() {
  AuroraParameters parameters;
  parameters.density.longest = 6;
  return parameters;
}

const std::map<std::string, Factory>& factories() {
  static const std::map<std::string, Factory> all{
      {"aurora", make<Aurora>},
      {"aurora-davis", [] { return makeWith<Aurora>(auroraOnDavis()); }},
      {"datmo", make<Datmo>},
      {"difference", make<Difference>},
      {"difference-davis",
       [] {
         return makeWith<Difference>(DifferenceParameters{1, 35});
       }},
      {"flow-residual", make<FlowResidual>},
      {"flow-residual-davis",
       [] {
         return makeWith<FlowResidual>(FlowResidualParameters{1, 35, 11.5F});
       }},
      {"homography-mog2", make<HomographyMog2>},
      {"lrr", makeLrr},
      {"mcd", make<Mcd>},
      {"meier", make<Meier>},
      {"rv", makeRandomizedVoting},
      {"ssc", makeSsc},
  };
  return all;
}

}  // namespace

bool Rival::fits(const RivalInput& input) const {
  const bool grey = !input.grey.empty() && input.grey.type() == CV_8U;
  const bool colour = input.colour.type() == CV_8UC3 && input.colour.size() == input.grey.size();
  return grey && (colour || !wantsColour());
}

RivalOutput Rival::beginAnew(const RivalInput& input) {
  reset();
  RivalOutput output = judge(input);
  output.status = RivalStatus::kLost;
  return output;
}

RivalOutput Rival::step(const RivalInput& input) {
  RivalOutput output;
  if (!fits(input)) {
    reset();
    output.status = RivalStatus::kBadImage;
  } else {
    const bool first = !last_utime_;
    const bool follows = !first && input.utime > *last_utime_ &&
                         input.utime - *last_utime_ <= kMaxFrameGapUs && input.grey.size() == size_;
    size_ = input.grey.size();
    if (first || follows) output = judge(input);
    if ((!first && !follows) || output.status == RivalStatus::kLost) output = beginAnew(input);
    last_utime_ = input.utime;
  }
  if (output.status != RivalStatus::kGood) {
    output.score = cv::Mat::zeros(size_, CV_8U);
    output.background = cv::Matx33d::eye();
  }
  return output;
}

std::unique_ptr<Rival> makeRival(const std::string& name) {
  const auto found = factories().find(name);
  return found == factories().end() ? nullptr : found->second();
}

std::vector<std::string> rivalNames() {
  std::vector<std::string> names;
  for (const auto& [name, factory] : factories()) names.push_back(name);
  return names;
}

}  // namespace redbee
