// Fuzzes RTDE as the emulated controller reads it. The same bytes must leave the same answers and
// the same inputs whether they arrive at once or in pieces.
#include "sim_plant/ur/wire/rtde_session.hpp"
#include "tests/fuzz/fuzzing.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

/// A controller's side of one connection.
struct Side {
  RtdeSession session;
  Io io;
  Claims claims;
  Outbox out;
  bool follows = true;

  void play(const fuzz::Tape& tape) {
    const Version version;
    const RtdeContext context{version, io, claims, 1};
    session.open(0);
    tape.deal([&](const std::uint8_t* data, std::size_t size) {
      follows = follows && session.receive(data, size, context, out);
    });
    for (int i = 0; i < 3; ++i) session.tick(Image{}, out);
  }
};

/// A client must be sent complete packets, the last one included.
void check_packets(const Outbox& out) {
  std::size_t at = 0;
  while (at < out.size()) {
    MUST(out.size() - at >= kRtdeHeader);
    const std::size_t length = std::size_t{out.data()[at]} << 8 | out.data()[at + 1];
    MUST(length >= kRtdeHeader && length <= out.size() - at);
    at += length;
  }
}

void check_inputs(const Io& io) {
  MUST(io.speed_fraction >= 0.0 && io.speed_fraction <= 1.0);
  for (const double output : io.analog_outputs) MUST(output >= 0.0 && output <= 10.0);
}

bool same(const Io& a, const Io& b) {
  return std::memcmp(&a.input, &b.input, sizeof a.input) == 0 && a.written == b.written &&
         a.digital_outputs == b.digital_outputs && a.analog_outputs == b.analog_outputs &&
         a.speed_fraction == b.speed_fraction;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Side whole, cut;
  whole.~Side();
  cut.~Side();
  new (&whole) Side;
  new (&cut) Side;
  fuzz::Tape tape(data, size);
  cut.play(tape);
  tape.piece = std::max<std::size_t>(tape.size, 1);
  whole.play(tape);
  check_packets(whole.out);
  check_inputs(whole.io);
  MUST(whole.follows == cut.follows);
  MUST(whole.out.size() == cut.out.size() && whole.out.dropped() == cut.out.dropped());
  MUST(std::memcmp(whole.out.data(), cut.out.data(), cut.out.size()) == 0);
  MUST(same(whole.io, cut.io));
  return 0;
}
