// SPDX-License-Identifier: Apache-2.0
#include "core/choice/params.hpp"

namespace foretrack {

ParamRows rows(ChoiceParams& p) {
  return {
      {"start", &p.start, "", 0, 3,
       "who is followed first where several are seen: 0 whom the detector is most certain of, 1 "
       "the nearest, 2 who is in the middle of the image; 3 nobody but who wears the colour below"},
      {"start_red", &p.start_red, "", 0, 255,
       "of the upper body's clothes in the image, with start 3: red"},
      {"start_green", &p.start_green, "", 0, 255, "the same: green"},
      {"start_blue", &p.start_blue, "", 0, 255, "the same: blue"},
      {"wait_s", &p.wait_s, "s", 0.0, 600.0,
       "who is asked which of two it is has so long to answer"},
      {"unanswered", &p.unanswered, "", 0, 1, "then: 0 on with the likeliest, 1 hold"},
      {"alike", &p.alike, "", 0.05, 5.0, "clothes that differ more are somebody else's"},
      {"tell_apart", &p.tell_apart, "", 0.0, 5.0,
       "of two people, clothes whose differences from what is remembered are nearer are alike"},
      {"meet_m", &p.meet_m, "m", 0.0, 5.0,
       "people this near, or in line as seen from the vehicle, may be mixed up"},
      {"settle_s", &p.settle_s, "s", 0.0, 10.0,
       "after they have parted, they are compared for so long"},
      {"doubtful_looks", &p.doubtful_looks, "", 1, 1000,
       "images that leave a doubt who is who, for it to count"},
      {"learn_s", &p.learn_s, "s", 0.1, 3600.0,
       "time in which what is remembered of the clothes follows them"},
      {"search_s", &p.search_s, "s", 0.0, 3600.0, "who is not found for so long is lost"},
      {"candidate_s", &p.candidate_s, "s", 0.0, 10.0,
       "somebody must be seen so long to be compared"},
  };
}

}  // namespace foretrack
