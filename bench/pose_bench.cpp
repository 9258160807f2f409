// SPDX-License-Identifier: Apache-2.0
// CPU time of one image: tracked, and with the detector, for each model; of the calling thread.
//   pose_bench [PICTURE] [IMAGES]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/perception/detect_people.hpp"
#include "core/perception/perceive_image.hpp"
#include "core/perception/sample_image.hpp"
#include "core/perception/watch_others.hpp"
#include "services/common/time_now.hpp"
#include "services/files/models/pose_models.hpp"
#include "services/files/share/share.hpp"
#include "services/offline/images/frame_source.hpp"

namespace {

using namespace foretrack;

template <class Call>
void measure(const char* what, int images, Call call) {
  std::vector<double> times;
  for (int k = 0; k < images; ++k) {
    const double before = cpu_ms();
    call(k);
    times.push_back(cpu_ms() - before);
  }
  std::sort(times.begin(), times.end());
  std::printf("  %-22s %6.2f %6.2f %6.2f\n", what, times.front(), times[times.size() / 2],
              times[times.size() * 95 / 100]);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string picture = argc > 1 ? argv[1] : find_share("tests/data/basketball.png").string();
  const int images = argc > 2 ? std::atoi(argv[2]) : 200;
  const RgbImage image = load_picture(picture);
  const PerceptionParams params;
  std::printf("%s, %d × %d; ms of CPU: least, median, P95 of %d\n", picture.c_str(), image.width_px,
              image.height_px, images);
  for (const int model : {0, 1, 2}) {
    PoseNetwork network = load_shipped_pose_network(model);
    PoseState state;
    perceive_image(state, image, 0.0, network, params);
    std::printf("model complexity %d\n", model);
    const int count = model == 2 ? images / 4 + 1 : images;
    measure("tracked image", count,
            [&](int k) { perceive_image(state, image, 0.03 * (k + 1), network, params); });
    measure("  and others watched", count, [&](int k) {
      const double stamp_s = 1e3 + 0.0333 * k;
      perceive_image(state, image, stamp_s, network, params);
      watch_others(state, image, stamp_s, network, params);
    });
    measure("  of it the network", count, [&](int) { network.landmarks->run(); });
    measure("  of it the sampling", count, [&](int) {
      sample_region(image, *state.chosen.region, Border::kRepeated, 256, 1.0f, 0.0f,
                    network.landmarks->input());
    });
    if (model == 0)
      measure("detector", count,
              [&](int) { detect_people(image, whole_of(image), *network.detector, 0.5); });
  }
}
