// ScriptCheck: reads a plain program before it runs, and finds the first place that the interpreter
// of lines does not understand: threads, functions of the program within an expression, functions
// that are not emulated, names without a value, and what is no line of URScript. Such a program is
// refused as a whole, because an arm that does half of a program is worse than one that stands.
#pragma once

#include "sim_plant/ur/script/script_expression.hpp"

namespace tactus::ur {

/// The first fault of a program: line and column from 1, and the name or word.
struct ScriptFault {
  enum class Kind : std::uint8_t {
    kNameNotFound,  ///< as on the robot
    kNotEmulated,   ///< the robot knows it
    kSyntax,
  };
  Kind kind = Kind::kSyntax;
  int line = 0, column = 0;
  std::string_view name;
};

class ScriptCheck {
 public:
  /// Takes the whole text: "def name(): ... end", "sec name(): ... end", or a single line.
  explicit ScriptCheck(std::string_view program) : program_(program) {}

  /// True if there is a fault.
  bool find(ScriptFault& fault);

 private:
  bool collect_variables();
  bool good_line(std::string_view line);
  bool good_definition(std::string_view line);
  bool good_block(std::string_view word, std::string_view line);
  bool good_statement(std::string_view line);
  bool good_assignment(std::string_view rest);
  bool good_call(std::string_view line);
  bool whole(std::string_view text, std::string_view after);
  bool blame(std::string_view name);
  bool defines(std::string_view name) const;
  std::size_t count_parameters(std::string_view name) const;
  ScriptFault::Kind kind_of(std::string_view name) const;

  static constexpr std::size_t kNone = ~std::size_t{0};

  std::string_view program_;
  ScriptVariables variables_;  // every name that some line assigns
  std::string_view strange_;   // the name or word to blame
};

}  // namespace tactus::ur
