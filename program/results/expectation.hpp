// Expectation: measures in the cycle what [expect] states, and judges it at the end of a run.
#pragma once

#include <cstdio>

#include "program/session/expect_section.hpp"

namespace tactus {

class Expectation {
 public:
  /// False: the section contradicts itself; prints "path: [expect] key: reason" to stderr. [init]
  bool start(const ExpectSection& section, double period_s, const char* path);
  /// Takes the wrench of a cycle. [cyclic]
  void add();

  bool stated() const { return section_.stated(); }
  double contact_force() const { return largest_; }  ///< N
  bool met() const;
  /// Prints the bound that was missed to stderr; nothing if all were met.
  void print_miss(const char* path) const;
  /// Writes the line `"expect": {...},` of summary.json, if anything was stated.
  void write(std::FILE* file) const;
  /// Prints the same for people.
  void print() const;

 private:
  ExpectSection section_;
  double share_ = 1.0;                 // of a cycle in the average
  Vector3 average_ = Vector3::Zero();  // N
  double largest_ = 0.0;               // N
};

}  // namespace tactus
