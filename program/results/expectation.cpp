#include "program/results/expectation.hpp"

#include <algorithm>
#include <cmath>

namespace tactus {
namespace {

bool tracks(const Recording& recording, Quantity quantity) {
  const auto end = recording.tracking.begin() + recording.tracking_count;
  return std::any_of(recording.tracking.begin(), end, [&](const Tracking& tracking) {
    return tracking.reference->quantity == quantity;
  });
}

const char* said(bool met) {
  return met ? "true" : "false";
}

const char* verdict(bool met) {
  return met ? "as expected" : "not as expected";
}

}  // namespace

bool Expectation::start(const ExpectSection& section, const Pipeline& pipeline, const char* path) {
  *this = {};
  section_ = section;
  const double period_s = pipeline.robot.period_s();
  share_ = section.average_s > 0.0 ? -std::expm1(-period_s / section.average_s) : 1.0;
  return !refuse_contradiction(pipeline.recording, path) &&
         stop_.start(section.collision_stop, pipeline, path);
}

/// Prints why the section cannot be judged; false if it can.
bool Expectation::refuse_contradiction(const Recording& recording, const char* path) const {
  if (section_.states_force() && !section_.h.wired()) {
    std::fprintf(stderr,
                 "%s: [expect] h: the input is not connected; the bounds are of its force\n", path);
    return true;
  }
  if (!(section_.contact_force_min <= section_.contact_force_max)) {
    std::fprintf(stderr, "%s: [expect] contact_force_max: %g N is below contact_force_min, %g N\n",
                 path, section_.contact_force_max, section_.contact_force_min);
    return true;
  }
  const bool joints = section_.tracking_rad > 0.0 && !tracks(recording, Quantity::kJointPosition);
  const bool tip = section_.tracking_m > 0.0 && !tracks(recording, Quantity::kPose);
  if (!joints && !tip) return false;
  std::fprintf(stderr,
               "%s: [expect] %s: no error of %s is measured; name the two outputs in [recorder] "
               "tracking, reference first\n",
               path, joints ? "tracking_rad" : "tracking_m", joints ? "joint positions" : "a pose");
  return true;
}

void Expectation::add() {
  average_ += share_ * (section_.h->head<3>() - average_);
  largest_ = std::max(largest_, average_.norm());
}

void Expectation::take(const TrackingError* errors, int count) {
  for (int i = 0; i < count; ++i) {
    const Quantity quantity = errors[i].tracking().reference->quantity;
    if (quantity == Quantity::kPose) tracked_m_ = larger_error(tracked_m_, errors[i].distance());
    if (quantity != Quantity::kJointPosition) continue;
    for (int c = 0; c < errors[i].components(); ++c)
      tracked_rad_ = larger_error(tracked_rad_, errors[i].max(c));
  }
}

std::array<Expectation::Bound, 4> Expectation::bounds() const {
  const ExpectSection& s = section_;
  const bool force = s.states_force();
  return {{{"contact_force_min", "contact force", "N", largest_, s.contact_force_min, force, true,
            ": did the tool touch anything?"},
           {"contact_force_max", "contact force", "N", largest_, s.contact_force_max, force, false,
            ": is the surface nearer than the reference assumes?"},
           {"tracking_rad", "error of a joint", "rad", tracked_rad_, s.tracking_rad,
            s.tracking_rad > 0.0, false, ""},
           {"tracking_m", "error of the tip", "m", tracked_m_, s.tracking_m, s.tracking_m > 0.0,
            false, ""}}};
}

bool Expectation::met() const {
  const auto all = bounds();
  return stop_.met() &&
         std::all_of(all.begin(), all.end(), [](const Bound& bound) { return bound.met(); });
}

void Expectation::print_misses(const char* path) const {
  for (const Bound& b : bounds()) {
    if (b.met()) continue;
    std::fprintf(stderr, "%s: [expect] %s: the largest %s was %.9g %s, expected %s %.9g %s%s\n",
                 path, b.key, b.what, b.seen, b.unit, b.side(), b.limit, b.unit, b.hint);
  }
  if (!stop_.met())
    std::fprintf(stderr, "%s: [expect] collision_stop: the arm was %s, expected %s\n", path,
                 stop_.seen().c_str(), stop_.expected().c_str());
}

void Expectation::write(std::FILE* file) const {
  const char* separator = "  \"expect\": {";
  bool any = false;
  for (const Bound& b : bounds()) {
    if (!b.stated) continue;
    std::fprintf(file, "%s\"%s\": {\"seen\": %.9g, \"stated\": %.9g}", separator, b.key, b.seen,
                 b.limit);
    separator = ", ";
    any = true;
  }
  if (stop_.stated())
    std::fprintf(file, "%s\"collision_stop\": {\"seen\": \"%s\", \"stated\": \"%s\", \"met\": %s}",
                 separator, stop_.seen().c_str(), stop_.pair().c_str(), said(stop_.met()));
  any = any || stop_.stated();
  if (any) std::fprintf(file, ", \"met\": %s},\n", said(met()));
}

void Expectation::print() const {
  const char* line = "\n";
  for (const Bound& b : bounds()) {
    if (!b.stated) continue;
    std::printf("%s  largest %s %.3g %s, expected %s %g: %s\n", line, b.what, b.seen, b.unit,
                b.side(), b.limit, verdict(b.met()));
    line = "";
  }
  if (stop_.stated())
    std::printf("%s  %s, expected %s: %s\n", line, stop_.seen().c_str(), stop_.expected().c_str(),
                verdict(stop_.met()));
}

}  // namespace tactus
