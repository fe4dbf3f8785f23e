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
  std::printf(" Period %d to %d us.\n", static_cast<int>(offered.min_period_us),
              static_cast<int>(offered.max_period_us));
  std::printf(
      "A number per joint may be given once for all joints. What is tunable may change while the\n"
      "pipeline runs (gateway.md). Limits and defaults are this\n"
      "robot's, sections this board's: `build/<board>/tactus ports` prints another's.\n");
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
