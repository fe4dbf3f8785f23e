// The text of URScript: lines, names and numbers, and its values, variables and calls.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "kernel/core/types.hpp"

namespace tactus::ur {

void skip_blanks(std::string_view& text);
/// Takes a number without a minus off the text. False: there is none, and `value` is unchanged.
bool read_number(std::string_view& text, double& value);
/// Rounds towards zero and limits to the range of an integer; 0 for NaN.
std::int32_t integer(double value);
/// Takes the next line off a text, without its end. False: there is none.
bool next_line(std::string_view& text, std::string_view& line);
std::string_view trimmed(std::string_view text);
/// Returns a line without its comment; a # in quotes does not begin one.
std::string_view without_comment(std::string_view line);

/// Joins, in place, every line whose brackets stay open with those that close them, without their
/// comments. The ends of lines follow the statement, so that what comes after keeps its number.
/// Returns the new size, which is not larger.
std::size_t join_lines(char* text, std::size_t size);
/// Returns a statement without "global" or "local".
std::string_view without_scope(std::string_view line);
/// Returns the identifier at the beginning of a text; empty if there is none.
std::string_view leading_name(std::string_view text);
bool starts_with(std::string_view text, std::string_view word);
/// Finds the number after the first `key` in the text. False: there is none.
bool number_after(std::string_view text, std::string_view key, double& value);

/// "name = value" or, for an element, "name[index] = value".
struct ScriptAssignment {
  std::string_view name, index, value;
  bool element = false;
};
/// False: the line is no assignment.
bool read_assignment(std::string_view line, ScriptAssignment& found);

struct ScriptValue {
  enum class Kind : std::uint8_t { kNothing, kNumber, kBool, kText, kList, kPose };
  Kind kind = Kind::kNothing;
  double number = 0.0;               ///< 0 or 1 for a bool
  std::string_view text;             ///< without quotes
  std::array<double, 8> elements{};  ///< of a list or a pose
  std::size_t count = 0;

  static ScriptValue of(double value) { return {Kind::kNumber, value, {}, {}, 0}; }
  static ScriptValue of(bool value) { return {Kind::kBool, value ? 1.0 : 0.0, {}, {}, 0}; }
  bool numeric() const { return kind == Kind::kNumber || kind == Kind::kBool; }
  bool six() const { return (kind == Kind::kList || kind == Kind::kPose) && count == 6; }
  Vector6 vector() const { return Vector6(elements.data()); }
};

/// A call whose arguments are values, by position or by name.
struct ScriptCall {
  static constexpr std::size_t kMost = 10;
  struct Argument {
    std::string_view name;
    ScriptValue value;
  };
  std::string_view name;
  std::array<Argument, kMost> arguments;
  std::size_t count = 0;

  /// Finds an argument by name or by position; null if it is not given.
  const ScriptValue* find(std::string_view argument, std::size_t position) const;
  double number(std::string_view argument, std::size_t position, double otherwise) const;
};

constexpr std::string_view kTooManyVariables = "limit of 64 variables";

/// The variables that were assigned, by name.
class ScriptVariables {
 public:
  const ScriptValue* find(std::string_view name) const;
  ScriptValue* find(std::string_view name);
  /// Assigns a value. False: too many variables.
  bool set(std::string_view name, const ScriptValue& value);

 private:
  struct Row {
    std::string_view name;
    ScriptValue value;
  };
  std::array<Row, 64> rows_;
  std::size_t count_ = 0;
};

}  // namespace tactus::ur
