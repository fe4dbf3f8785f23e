// Fuzzes RTDE as the HAL reads it: the conversation of the start, then data packages.
#include "hal/ur/rtde_client.hpp"
#include "tests/fuzz/ur/wire.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

constexpr int kMostInOneCycle = 128;

bool finite(const UrState& state) {
  return state.q.allFinite() && state.dq.allFinite() && state.target_q.allFinite() &&
         state.moment.allFinite() && state.tcp_pose.allFinite() && state.tcp_force.allFinite() &&
         std::isfinite(state.timestamp_s) && std::isfinite(state.speed_scaling) &&
         std::isfinite(state.speed_fraction);
}

bool known(Status status) {
  return status == Status::kConnectionLost || status == Status::kBusTimeout ||
         status == Status::kRefusedByRobot || status == Status::kRegistersInUse ||
         status == Status::kWireFormat;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::Tape tape(data, size);
  fuzz::wire.play(tape);
  RtdeClient client;
  UrState state;
  Message why;
  Status status = client.start("127.0.0.1", 30004, 125.0, true, Deadline(100), why);
  MUST(client.running() == (status == Status::kOk));
  while (status == Status::kOk) {
    const std::size_t before = fuzz::wire.at;
    int count = 0;
    status = client.receive(state, count, why);
    MUST(count >= 0 && count <= kMostInOneCycle);
    MUST(finite(state));
    if (status == Status::kOk && count == 0 && fuzz::wire.at == before) break;
  }
  MUST(status == Status::kOk || (known(status) && !std::string_view(why).empty()));
  return 0;
}
