#include "sim_plant/ur/wire/rtde_fields.hpp"

namespace tactus::ur {
namespace {

bool eat(std::string_view& text, std::string_view word) {
  if (text.substr(0, word.size()) != word) return false;
  text.remove_prefix(word.size());
  return true;
}

/// Returns the number that a text of up to three digits is; -1 for other texts.
int number(std::string_view text) {
  if (text.empty() || text.size() > 3 || (text.size() > 1 && text[0] == '0')) return -1;
  int value = 0;
  for (const char c : text) {
    if (c < '0' || c > '9') return -1;
    value = 10 * value + (c - '0');
  }
  return value;
}

}  // namespace

bool parse_register(std::string_view name, const Version& version, RegisterName& parsed) {
  const int registers = version.at_least(3, 9) ? kRegisters : kRegisters / 2;
  parsed.input = name.substr(0, 6) == "input_";
  if (!eat(name, "input_") && !eat(name, "output_")) return false;
  if (name == "bit_registers0_to_31" || name == "bit_registers32_to_63") {
    parsed.kind = Input::kBits;
    parsed.index = name == "bit_registers0_to_31" ? 0 : 1;
    return true;
  }
  if (eat(name, "bit_register_")) {
    parsed.kind = Input::kBit;
    parsed.index = number(name);
    return version.at_least(3, 9) && parsed.index >= 64 && parsed.index < kBitRegisters;
  }
  if (eat(name, "int_register_")) {
    parsed.kind = Input::kInts;
  } else if (eat(name, "double_register_")) {
    parsed.kind = Input::kDoubles;
  } else {
    return false;
  }
  parsed.index = number(name);
  return parsed.index >= 0 && parsed.index < registers;
}

}  // namespace tactus::ur
