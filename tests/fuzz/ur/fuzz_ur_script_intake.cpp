// Fuzzes the division of a script port's text into programs and lines. The result must not depend
// on how the stream is cut, and must hold no byte that was not sent.
#include "sim_plant/ur/programs/runner.hpp"
#include "tests/fuzz/fuzzing.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

/// The lines and programs handed on, in order.
struct Taken {
  ScriptIntake intake;
  std::array<char, 1 << 16> text;
  std::size_t size = 0, count = 0;

  void play(const fuzz::Tape& tape) {
    intake.clear();
    size = count = 0;
    tape.deal([&](const std::uint8_t* data, std::size_t length) {
      intake.take(data, length, [&](std::string_view piece) {
        MUST(!piece.empty() && piece.back() == '\n');
        MUST(piece.size() <= text.size() - size);
        std::memcpy(text.data() + size, piece.data(), piece.size());
        size += piece.size();
        ++count;
      });
    });
  }
  std::string_view all() const { return {text.data(), size}; }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Taken whole, cut;
  fuzz::Tape tape(data, std::min<std::size_t>(size, 1 << 16));
  cut.play(tape);
  tape.piece = std::max<std::size_t>(tape.size, 1);
  whole.play(tape);
  MUST(whole.count == cut.count && whole.all() == cut.all());
  MUST(whole.size <= tape.size);
  return 0;
}
