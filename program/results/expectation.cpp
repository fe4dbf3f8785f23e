#include "program/results/expectation.hpp"

#include <algorithm>
#include <cmath>

namespace tactus {

bool Expectation::start(const ExpectSection& section, double period_s, const char* path) {
  *this = {};
  section_ = section;
  share_ = section.average_s > 0.0 ? -std::expm1(-period_s / section.average_s) : 1.0;
  if (section.stated() && !section.h.wired()) {
    std::fprintf(stderr,
                 "%s: [expect] h: the input is not connected; the bounds are of its force\n", path);
    return false;
  }
  if (section.contact_force_min <= section.contact_force_max) return true;
  std::fprintf(stderr, "%s: [expect] contact_force_max: %g N is below contact_force_min, %g N\n",
               path, section.contact_force_max, section.contact_force_min);
  return false;
}

void Expectation::add() {
  average_ += share_ * (section_.h->head<3>() - average_);
  largest_ = std::max(largest_, average_.norm());
}

bool Expectation::met() const {
  return largest_ >= section_.contact_force_min && largest_ <= section_.contact_force_max;
}

void Expectation::print_miss(const char* path) const {
  if (met()) return;
  const bool below = largest_ < section_.contact_force_min;
  std::fprintf(
      stderr,
      "%s: [expect] contact_force_%s: the largest contact force was %.9g N, expected at "
      "%s %g N: %s\n",
      path, below ? "min" : "max", largest_, below ? "least" : "most",
      below ? section_.contact_force_min : section_.contact_force_max,
      below ? "did the tool touch anything?" : "is the surface nearer than the reference assumes?");
}

void Expectation::write(std::FILE* file) const {
  if (!stated()) return;
  std::fprintf(file,
               "  \"expect\": {\"contact_force\": %.9g, \"contact_force_min\": %.9g, "
               "\"contact_force_max\": %.9g, \"met\": %s},\n",
               largest_, section_.contact_force_min, section_.contact_force_max,
               met() ? "true" : "false");
}

void Expectation::print() const {
  if (!stated()) return;
  std::printf("\n  largest contact force %.3g N, expected %g to %g N: %s\n", largest_,
              section_.contact_force_min, section_.contact_force_max,
              met() ? "as expected" : "not as expected");
}

}  // namespace tactus
