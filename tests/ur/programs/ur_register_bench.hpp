// A controller that runs the register program; the test is the client that writes the registers.
// The texts contain only what the emulator needs to tell them apart.
#pragma once

#include "tests/ur/programs/ur_program_bench.hpp"

namespace tactus::ur {

struct RegisterBench : ProgramBench {
  using ProgramBench::ProgramBench;

  static constexpr std::string_view kHead = "def rtde_control():\n";
  static constexpr std::string_view kOffset =
      "  global reg_offset_float = 24\n"
      "  global reg_offset_int = 24\n";
  static constexpr std::string_view kBody =
      "  def signal_ready():\n"
      "    write_output_integer_register(0 + reg_offset_int, 1)\n"
      "  end\n"
      "  def rtde_cmd():\n"
      "    return read_input_integer_register(0 + reg_offset_int)\n"
      "  end\n"
      "  def process_cmd(cmd):\n"
      "    if cmd == 1:\n"
      "      movej(q, a, v)\n"
      "    end\n"
      "  end\n"
      "  while keep_running:\n"
      "    process_cmd(rtde_cmd())\n"
      "    sync()\n"
      "  end\n"
      "end\n";

  std::size_t offset = 0;
  std::array<char, 4096> text;

  /// `more`: functions placed before the others.
  void start(bool with_offset = false, std::string_view more = {}) {
    std::size_t size = 0;
    for (const std::string_view part :
         {kHead, with_offset ? kOffset : std::string_view(), more, kBody}) {
      if (!part.empty()) std::memcpy(text.data() + size, part.data(), part.size());
      size += part.size();
    }
    offset = with_offset ? 24 : 0;
    upload({text.data(), size});
    run(3);
    assert_true(running());
    assert_int_equal(answer(), 1);
  }
  std::int32_t answer(std::size_t i = 0) { return machine().io.output.ints[offset + i]; }
  Vector6 answered() { return Vector6(machine().io.output.doubles.data() + offset); }
  void write(std::int32_t command, std::initializer_list<double> values = {},
             std::int32_t second = 0) {
    std::size_t i = offset;
    for (const double value : values) machine().io.input.doubles[i++] = value;
    machine().io.input.ints[offset + 1] = second;
    machine().io.input.ints[offset] = command;
  }
  void write(std::int32_t command, const Vector6& first, std::initializer_list<double> more = {}) {
    std::copy(first.begin(), first.end(), machine().io.input.doubles.begin() + offset);
    std::copy(more.begin(), more.end(), machine().io.input.doubles.begin() + offset + 6);
    machine().io.input.ints[offset + 1] = 0;
    machine().io.input.ints[offset] = command;
  }
  /// Waits for "done", withdraws the command and waits for "ready". Returns the number of cycles.
  int finish() {
    int cycles = 0;
    for (; answer() != 2 && cycles < 1500; ++cycles) tick();
    assert_int_equal(answer(), 2);
    write(0);
    run(2);
    assert_int_equal(answer(), 1);
    return cycles;
  }
  /// Runs a command as a client does.
  int command(std::int32_t number, std::initializer_list<double> values = {},
              std::int32_t second = 0) {
    write(number, values, second);
    return finish();
  }
};

}  // namespace tactus::ur
