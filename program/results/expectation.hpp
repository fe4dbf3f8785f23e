// Expectation: measures in the cycle what [expect] states, and judges it at the end of a run.
#pragma once

#include <array>
#include <cstdio>

#include "program/results/tracking_error.hpp"
#include "program/session/expect_section.hpp"
#include "program/session/stop_expectation.hpp"

namespace tactus {

class Expectation {
 public:
  /// False: the section contradicts itself, or what it bounds is not measured; prints
  /// "path: [expect] key: reason" to stderr. [init]
  bool start(const ExpectSection& section, const Pipeline& pipeline, const char* path);
  /// Takes the wrench of a cycle. [cyclic]
  void add();
  /// Takes the tracking errors of the whole run, `count` of them. [any]
  void take(const TrackingError* errors, int count);

  /// The stop that is stated, which takes how the run ended.
  StopExpectation& stop() { return stop_; }

  bool met() const;
  /// Prints the bounds that were missed to stderr; nothing if all were met.
  void print_misses(const char* path) const;
  /// Writes the line `"expect": {...},` of summary.json, if anything was stated.
  void write(std::FILE* file) const;
  /// Prints the same for people.
  void print() const;

 private:
  /// One bound of the section, and what was seen of it.
  struct Bound {
    const char *key, *what, *unit;
    double seen, limit;
    bool stated, least;
    const char* hint;

    bool met() const { return !stated || (least ? seen >= limit : seen <= limit); }
    const char* side() const { return least ? "at least" : "at most"; }
  };
  std::array<Bound, 4> bounds() const;
  bool refuse_contradiction(const Recording& recording, const char* path) const;

  ExpectSection section_;
  StopExpectation stop_;
  double share_ = 1.0;                          // of a cycle in the average
  Vector3 average_ = Vector3::Zero();           // N
  double largest_ = 0.0;                        // N
  double tracked_rad_ = 0.0, tracked_m_ = 0.0;  // the largest errors
};

}  // namespace tactus
