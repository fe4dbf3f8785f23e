// Fuzzes the 2015 driver's stream of set-points: seven integers each, cut anywhere. A record is one
// byte, which gives the number of bytes sent at once and of cycles after them, and these bytes.
#include "tests/fuzz/ur_controller.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

constexpr std::string_view kText =
    "def driver():\n"
    "  socket_open(\"10.0.0.7\", 50001)\n"
    "  params = socket_read_binary_integer(7)\n"
    "  servoj(q, 3, 1, 0.008, lookahead_time=0.03, gain=500)\n"
    "end\n";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::RunningController controller;
  controller->runner().upload(kText, controller.machine());
  controller.ticks(2);
  Link& link = *controller.machine().links.find("socket_0");
  int left = 100;  // cycles
  while (size > 0 && left > 0 && link.open()) {
    const int cycles = data[0] >> 5;
    const std::size_t piece = std::min<std::size_t>(data[0] & 0x1f, size - 1);
    link.receive(data + 1, piece);
    controller.ticks(cycles);
    left -= cycles + 1;
    data += 1 + piece;
    size -= 1 + piece;
  }
  // The program outlives a control computer that has left; the arm comes to rest.
  link.lost();
  controller.comes_to_rest();
  return 0;
}
