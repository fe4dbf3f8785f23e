// The text of URScript: lines, names, numbers; and what it speaks of: values, variables, calls.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "kernel/types.hpp"

namespace tactus::ur {

void skip_blanks(std::string_view& text);
/// Takes a number without a minus off the text; false: there is none, and `value` is as it was.
bool read_number(std::string_view& text, double& value);
/// Towards zero, and within the range of an integer; 0 for what is no number.
std::int32_t integer(double value);
/// Lines of a text, without their ends. False: there is no other.
bool next_line(std::string_view& text, std::string_view& line);
std::string_view trimmed(std::string_view text);
/// Without a comment at its end; a # within quotes is none.
std::string_view without_comment(std::string_view line);
/// The identifier that a text begins with; empty: none.
std::string_view leading_name(std::string_view text);
bool starts_with(std::string_view text, std::string_view word);
/// The number behind the first `key` in the text; false: there is none.
bool number_after(std::string_view text, std::string_view key, double& value);

struct ScriptValue {
  enum class Kind : std::uint8_t { kNothing, kNumber, kBool, kText, kList, kPose };
  Kind kind = Kind::kNothing;
  double number = 0.0;               ///< of a bool 0 or 1
  std::string_view text;             ///< without its quotes
  std::array<double, 8> elements{};  ///< of a list or a pose
  std::size_t count = 0;

  bool numeric() const { return kind == Kind::kNumber || kind == Kind::kBool; }
  bool six() const { return (kind == Kind::kList || kind == Kind::kPose) && count == 6; }
  Vector6 vector() const { return Vector6(elements.data()); }
};

/// A call with arguments that are values: by position, or by name.
struct ScriptCall {
  static constexpr std::size_t kMost = 10;
  struct Argument {
    std::string_view name;
    ScriptValue value;
  };
  std::string_view name;
  std::array<Argument, kMost> arguments;
  std::size_t count = 0;

  /// By name, or by position; null: not given.
  const ScriptValue* find(std::string_view argument, std::size_t position) const;
  double number(std::string_view argument, std::size_t position, double otherwise) const;
};

/// Names of values that were assigned before.
struct ScriptVariables {
  struct Row {
    std::string_view name;
    ScriptValue value;
  };
  std::array<Row, 64> rows;
  std::size_t count = 0;

  const ScriptValue* find(std::string_view name) const;
  ScriptValue* find(std::string_view name);
  /// False: there is no room for another.
  bool set(std::string_view name, const ScriptValue& value);
};
}  // namespace tactus::ur
