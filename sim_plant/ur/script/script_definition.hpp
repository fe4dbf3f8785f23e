// The first line of a function of a program: "def name(a, b):".
#pragma once

#include "sim_plant/ur/script/script_text.hpp"

namespace tactus::ur {

/// Takes name and parameters off a line without blanks and comment. False: it defines no function.
inline bool read_definition(std::string_view line, std::string_view& name,
                            std::string_view& parameters) {
  if (leading_name(line) != "def") return false;
  line = trimmed(line.substr(3));
  name = leading_name(line);
  line = trimmed(line.substr(name.size()));
  const std::size_t end = line.find(')');
  if (name.empty() || !starts_with(line, "(") || end == std::string_view::npos) return false;
  parameters = trimmed(line.substr(1, end - 1));
  return trimmed(line.substr(end + 1)) == ":";
}

/// Takes the first name off a list of parameters; empty: there is none, or it is not a plain name.
inline std::string_view take_parameter(std::string_view& parameters) {
  const std::string_view name = leading_name(parameters);
  std::string_view rest = trimmed(parameters.substr(name.size()));
  if (!rest.empty() && rest[0] != ',') return {};
  if (!rest.empty()) rest = trimmed(rest.substr(1));
  parameters = rest;
  return name;
}

}  // namespace tactus::ur
