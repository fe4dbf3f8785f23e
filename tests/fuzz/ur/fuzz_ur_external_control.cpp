// Fuzzes external control's three sockets with arbitrary bytes from the control computer. A record
// is one byte, which selects the socket and the number of cycles after it, and the bytes of one
// message.
#include "tests/fuzz/ur/ur_controller.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

constexpr std::string_view kText =
    "def external():\n"
    "  servoj(q, t=steptime, lookahead_time=0.03, gain=2000)\n"
    "  write_output_float_register(1, spline_time)\n"
    "  connect_socket_with_retry(\"10.0.0.7\", 50003, \"trajectory_socket\")\n"
    "  connect_socket_with_retry(\"10.0.0.7\", 50004, \"script_command_socket\")\n"
    "  connect_socket_with_retry(\"10.0.0.7\", 50001, \"reverse_socket\")\n"
    "  socket_send_int(TRAJECTORY_RESULT_CANCELED, \"trajectory_socket\")\n"
    "  socket_close(\"reverse_socket\")\n"
    "  textmsg(\"behind\")\n"
    "end\n";

struct Socket {
  std::string_view name;
  std::size_t message;  // bytes
};
constexpr std::array<Socket, 3> kSockets = {{{"reverse_socket", 4 * kReverseInts},
                                             {"trajectory_socket", 4 * kTrajectoryInts},
                                             {"script_command_socket", 4 * kScriptCommandInts}}};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::RunningController controller;
  controller->runner().upload(kText, controller.machine());
  controller.ticks(6);
  int left = 100;  // cycles
  while (size > 0 && left > 0) {
    const Socket& socket = kSockets[data[0] % 3];
    const int cycles = std::min(left, data[0] / 3 % 16);
    const std::size_t message = std::min(size - 1, socket.message);
    if (Link* link = controller.machine().links.find(socket.name); link != nullptr && link->open())
      link->receive(data + 1, message);
    controller.ticks(cycles);
    left -= cycles + 1;
    data += 1 + message;
    size -= 1 + message;
  }
  controller.ticks(4);
  controller->runner().stop(controller.machine());
  controller.comes_to_rest();
  return 0;
}
