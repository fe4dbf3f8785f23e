// `tactus ports`: docs/ports.md, printed from the lists that the loader reads a file by.
#pragma once

#include <cmath>
#include <cstdio>

#include "kernel/core/names.hpp"
#include "kernel/pipeline/channels.hpp"
#include "kernel/pipeline/pipeline.hpp"
#include "program/session/options.hpp"

namespace tactus {

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
    row(key, "number per joint", unit, vector(value.data(), kDof, true), range);
  }
  void param(const char* key, const Vector3& value, const Range& range, const char* unit) {
    row(key, "3 numbers", unit, vector(value.data(), 3, false), range);
  }
  template <class Value>
  void tunable(const char* key, const Value& value, const Range& range, const char* unit) {
    tunable_ = true;
    param(key, value, range, unit);
    tunable_ = false;
  }
  void optional(const char* key, double, const Range& range, const char* unit) {
    row(key, "number", unit, Message("none"), range);
  }
  void optional(const char* key, const Vector3&, const Range& range, const char* unit) {
    row(key, "3 numbers", unit, Message("none"), range);
  }
  void optional(const char* key, const JointVector&, const Range& range, const char* unit) {
    row(key, "number per joint", unit, Message("none"), range);
  }
  void limit(const char* key, const JointVector& value, const char* unit) {
    std::printf("| `%s` | limit per joint | %s | %s | > 0, at most the default |\n", key, unit,
                vector(value.data(), kDof, true).c_str());
  }
  template <std::size_t N>
  void text(const char* key, const Text<N>&, const char* meaning) {
    std::printf("| `%s` | text: %s | | | |\n", key, meaning);
  }
  template <class List>
  void lines(const char* key, const List&, const char* meaning) {
    std::printf("| `%s` | lines: %s | | | |\n", key, meaning);
  }
  template <class Enum>
  void choice(const char* key, Enum& value) {
    std::printf("| `%s` | word | | %s |", key, name(value));
    const char* before = " ";
    for (const char* word : kNames<Enum>) {
      std::printf("%s%s", before, word);
      before = ", ";
    }
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
  /// As a file may have them: those of the joints once, if they are all the same.
  static Message vector(const double* values, int count, bool joints) {
    Message text;
    if (std::isnan(values[0])) return Message("required");
    bool same = joints;
    for (int i = 1; i < count; ++i) same = same && values[i] == values[0];
    for (int i = 0; i < (same ? 1 : count); ++i) text << (i > 0 ? " " : "") << values[i];
    return text;
  }
  void row(const char* key, const char* kind, const char* unit, const Message& value,
           const Range& range) const {
    std::printf("| `%s` | %s%s | %s | %s | %s |\n", key, tunable_ ? "tunable " : "", kind, unit,
                value.c_str(), (Message("") << range).c_str());
  }
  static void port(const char* key, const char* kind, Quantity quantity, const char* value) {
    std::printf("| `%s` | %s: %s | %s | %s | |\n", key, kind, info(quantity).name,
                info(quantity).unit, value);
  }

  bool tunable_ = false;
};

/// The visitor that prints a table for every section.
class SectionPrinter {
 public:
  template <class Settings>
  void section(const char* name, Settings& settings) {
    table((Message("[") << name << "]").c_str(), settings);
  }
  template <class Described>
  void table(const char* title, Described& described) {
    std::printf("\n## %s\n\n| name | what | unit | default | range |\n|---|---|---|---|---|\n",
                title);
    PortPrinter printer;
    described.describe(printer);
  }
};

/// The offer of a board and its robot.
void print_board(const char* board, const Capabilities& offered);
/// Every kind of block.
void print_blocks();

/// Prints every section and block, and of it every port, unit, setting, default and range, as
/// Markdown. `sections` are those that the board gives to its Loader. Returns the exit code.
template <class Sections>
int print_ports(const char* board, const Capabilities& offered, Pipeline& pipeline,
                Sections& sections) {
  print_board(board, offered);
  SectionPrinter printer;
  pipeline.describe(printer);
  sections.describe(printer);
  print_blocks();
  return kSucceeded;
}

}  // namespace tactus
