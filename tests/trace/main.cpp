// trace JOB: plays a job, on a machine with an operating system. Exit code 1 with a message on the
// error stream, 2 if the pipeline is refused.
#include <cstdio>

#include "tests/trace/traced_player.hpp"

int main(int argc, char** argv) {
  constexpr std::size_t kJobBytes = std::size_t{64} << 20;
  static std::uint8_t bytes[kJobBytes];
  static tactus::Waypoint<tactus::JointSpace> store[tactus::kLongestTape];
  std::FILE* const file = argc == 2 ? std::fopen(argv[1], "rb") : nullptr;
  if (file == nullptr) {
    std::fprintf(stderr, "usage: trace JOB, a file\n");
    return 1;
  }
  const std::size_t size = std::fread(bytes, 1, sizeof bytes, file);
  std::fclose(file);
  return tactus::play_job({bytes, size}, store, [](const char* line) { std::fputs(line, stdout); });
}
