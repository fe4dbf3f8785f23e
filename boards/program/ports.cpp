// `tactus ports`: docs/ports.md, printed from the one list of names each block has.
#include <cmath>
#include <cstdio>

#include "boards/program/session.hpp"
#include "sim_plant/plant_params.hpp"

namespace tactus {
namespace {

/// The visitor that prints a row for every setting and port.
class PortPrinter {
 public:
  void param(const char* key, double value, const Range& range, const char* unit) {
    row(key, "number", unit, std::isnan(value) ? Message("required") : Message("") << value, range);
  }
  void param(const char* key, int value, const Range& range, const char* unit) {
    row(key, "whole number", unit,
        value == kRequiredInt ? Message("required") : Message("") << value, range);
  }
  void param(const char* key, const JointVector& value, const Range& range, const char* unit) {
    row(key, "number per joint", unit, vector(value.data(), kDof), range);
  }
  void param(const char* key, const Vector3& value, const Range& range, const char* unit) {
    row(key, "3 numbers", unit, vector(value.data(), 3), range);
  }
  void limit(const char* key, const JointVector& value, const char* unit) {
    std::printf("| `%s` | limit per joint | %s | %s | > 0, at most the default |\n", key, unit,
                vector(value.data(), kDof).c_str());
  }
  template <std::size_t N>
  void text(const char* key, const Text<N>&, const char* meaning) {
    std::printf("| `%s` | text: %s | | | |\n", key, meaning);
  }
  template <class Enum, std::size_t N>
  void choice(const char* key, Enum& value, const std::array<const char*, N>& words) {
    std::printf("| `%s` | word | | %s |", key, words[static_cast<std::size_t>(value)]);
    for (std::size_t i = 0; i < N; ++i) std::printf("%s%s", i > 0 ? ", " : " ", words[i]);
    std::printf(" |\n");
  }
  template <Quantity Q>
  void in(const char* key, In<Q>&) {
    port(key, "input", Q, "required");
  }
  template <Quantity Q>
  void optional(const char* key, In<Q>&) {
    port(key, "input", Q, "neutral");
  }
  template <Quantity Q>
  void out(const char* key, Out<Q>&) {
    port(key, "output", Q, "");
  }
  template <class Space>
  void channel(ReferenceChannel<Space>*&) {}

 private:
  static Message vector(const double* values, int count) {
    Message text;
    if (std::isnan(values[0])) return Message("required");
    bool same = true;
    for (int i = 1; i < count; ++i) same = same && values[i] == values[0];
    for (int i = 0; i < (same ? 1 : count); ++i) text << (i > 0 ? " " : "") << values[i];
    return text;
  }
  static void row(const char* key, const char* kind, const char* unit, const Message& value,
                  const Range& range) {
    std::printf("| `%s` | %s | %s | %s | %s |\n", key, kind, unit, value.c_str(),
                (Message("") << range).c_str());
  }
  static void port(const char* key, const char* kind, Quantity quantity, const char* value) {
    std::printf("| `%s` | %s: %s | %s | %s | |\n", key, kind, info(quantity).name,
                info(quantity).unit, value);
  }
};

template <class Section>
void print_section(const char* title, Section&& section) {
  std::printf("\n## %s\n\n| name | what | unit | default | range |\n|---|---|---|---|---|\n",
              title);
  PortPrinter printer;
  section.describe(printer);
}

template <std::size_t I = 1>
void print_blocks() {
  if constexpr (I < std::variant_size_v<Block>) {
    print_section((Message("type = ") << kBlockTypes[I]).c_str(),
                  std::variant_alternative_t<I, Block>());
    print_blocks<I + 1>();
  }
}

}  // namespace

int print_ports(const char* board, const Capabilities& offered) {
  std::printf("# Sections, blocks and ports\n\nBoard `%s`, robot `%s`, %d joints. ", board,
              Robot::kName, kDof);
  std::printf("Commands:%s%s%s. Period %d to %d us.\n", offered.position ? " q_c" : "",
              offered.velocity ? " dq_c" : "", offered.effort ? " tau_c" : "",
              static_cast<int>(offered.min_period_us), static_cast<int>(offered.max_period_us));
  std::printf("A number per joint may be given once for all joints.\n");
  RobotSection robot;
  print_section("[robot]", robot);
  PortPrinter printer;
  robot.describe_command(printer);
  print_section("[guard]", Guard::Params());
  print_section("[collision]", CollisionSection());
  print_section("[task_limits]", TaskLimits());
  print_section("[executive]", ExecutiveSection());
  print_section("[recorder]", RecorderSection());
  print_section("[gateway]", GatewaySection());
  print_section("[realtime] (boards on Linux, with --realtime)", RealtimeSettings());
  print_section("[plant] (simulated boards)", PlantParams());
  print_blocks();
  return kSucceeded;
}

}  // namespace tactus
