// policy_replay describe: prints the robot's limits and where the benchmark begins, as JSON.
// policy_replay MODE CHUNKS PERIOD_US DURATION_S OUT [FADE_S SMOOTHING_S]: replays the chunks of a
// file: whole through the kernel (joint, task), or the targets that are due (rest, stream). Exit
// code 1: a fault in the replay; 2: mistakes in the arguments or the file.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/bench/policies/replay.hpp"
#include "tests/reference/motion/motion_bench.hpp"

namespace {

using namespace tactus;

void print(const char* name, const double* numbers, int count) {
  std::printf("\"%s\": [", name);
  for (int i = 0; i < count; ++i) std::printf("%s%.17g", i > 0 ? ", " : "", numbers[i]);
  std::printf("], ");
}

int describe() {
  const JointLimits joints;
  const TaskLimits tip;
  const Pose home = home_point<TaskSpace>().x;
  const double pose[] = {home.p.x(), home.p.y(), home.p.z(), home.r.w(),
                         home.r.x(), home.r.y(), home.r.z()};
  const double linear[] = {tip.v_max, tip.a_max, tip.j_max};
  const double angular[] = {tip.w_max, tip.alpha_max, tip.dalpha_max};
  std::printf("{");
  print("home", middle_of_range().data(), kDof);
  print("pose", pose, 7);
  print("dq_max", joints.dq_max.data(), kDof);
  print("ddq_max", joints.ddq_max.data(), kDof);
  print("dddq_max", joints.dddq_max.data(), kDof);
  print("linear", linear, 3);
  print("angular", angular, 3);
  std::printf("\"robot\": \"%s\"}\n", Robot::kName);
  return 0;
}

struct Mode {
  const char* name;
  int positions;  // numbers per position
  bool (*replay)(const std::vector<ChunkMessage>&, const Replay&);
};
constexpr Mode kModes[] = {{"joint", kDof, replay_chunks<JointSpace>},
                           {"task", 7, replay_chunks<TaskSpace>},
                           {"rest", kDof, replay_rest},
                           {"stream", kDof, replay_stream}};

const Mode* mode_of(const char* name) {
  for (const Mode& mode : kModes)
    if (std::strcmp(mode.name, name) == 0) return &mode;
  return nullptr;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "describe") == 0) return describe();
  const Mode* const mode = argc == 6 || argc == 8 ? mode_of(argv[1]) : nullptr;
  if (mode == nullptr) {
    std::fprintf(stderr,
                 "usage: policy_replay describe | MODE CHUNKS PERIOD_US DURATION_S OUT "
                 "[FADE_S SMOOTHING_S]\n");
    return 2;
  }
  Replay replay = {std::atoll(argv[3]), std::atof(argv[4]), argv[5]};
  if (argc == 8) {
    replay.fade_s = std::atof(argv[6]);
    replay.smoothing_s = std::atof(argv[7]);
  }
  std::vector<ChunkMessage> chunks;
  if (!read_chunks(argv[2], mode->positions, chunks)) return 2;
  if (chunks.empty() || replay.period_us <= 0) {
    std::fprintf(stderr, "%s: no chunk, or a period that is not positive\n", argv[2]);
    return 2;
  }
  return mode->replay(chunks, replay) ? 0 : 1;
}
