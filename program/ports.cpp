#include "program/ports.hpp"

#include "kernel/pipeline/kinds.hpp"

namespace tactus {
void print_board(const char* board, const Capabilities& offered) {
  std::printf("# Sections, blocks and ports\n\nBoard `%s`, robot `%s`, %d joints. ", board,
              Robot::kName, kDof);
  std::printf("Commands:%s%s%s.", offered.position ? " q_c" : "", offered.velocity ? " dq_c" : "",
              offered.effort ? " tau_c" : "");
  if (offered.velocity_feed_forward || offered.effort_feed_forward)
    std::printf(" Feed-forward:%s%s.", offered.velocity_feed_forward ? " dq_ff" : "",
                offered.effort_feed_forward ? " tau_ff" : "");
  int outputs = 0;
  for (std::uint32_t left = offered.outputs; left != 0; left &= left - 1) ++outputs;
  if (outputs > 0) std::printf(" Digital outputs: %d.", outputs);
  std::printf(" Period %d to %d us.\n", static_cast<int>(offered.min_period_us),
              static_cast<int>(offered.max_period_us));
  std::printf(
      "A number per joint may be given once for all joints. A tunable setting may change while\n"
      "the pipeline runs (gateway.md). An input with the default *neutral* may stay unwired and\n"
      "then has no effect; a setting with the default *none* may be left out. Limits and defaults\n"
      "are those of this robot, sections those of this board; `build/<board>/tactus ports` prints\n"
      "those of another.\n");
}

void print_blocks() {
  for (std::size_t i = 0; i < Kinds::kCount; ++i) {
    with_kind(i, [i](auto kind) {
      typename decltype(kind)::Type block;
      SectionPrinter().table((Message("type = ") << Kinds::kTypes[i]).c_str(), block);
    });
  }
}

}  // namespace tactus
