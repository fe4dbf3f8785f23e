#include "gateway/reference_frames.hpp"

namespace tactus {
namespace {

constexpr Fields kAllFields = kVelocityField | kAccelerationField | kEffortField;

std::string_view read_short_text(ByteReader& from) {
  return from.text(from.u8());
}

}  // namespace

void write_terms(ByteWriter& to, const TrajectoryTerms& terms) {
  to.u8(terms.poses ? 1 : 0);
  to.u8(terms.fields);
  to.u8(static_cast<std::uint8_t>(terms.interpolation));
  to.u8(terms.exact ? 1 : 0);
  to.f64(terms.start_s);
  to.u32(terms.held);
  to.short_text(terms.motion);
  to.short_text(terms.wrench);
}

bool read_terms(ByteReader& from, TrajectoryTerms& terms) {
  const std::uint8_t space = from.u8();
  terms.poses = space == 1;
  terms.fields = from.u8();
  terms.interpolation = static_cast<Interpolation>(from.u8());
  terms.exact = from.u8() != 0;
  terms.start_s = from.f64();
  terms.held = from.u32();
  terms.motion = read_short_text(from);
  terms.wrench = read_short_text(from);
  return from.done() && space <= 1 && terms.fields <= kAllFields &&
         name(terms.interpolation) != nullptr;
}

template <class Space>
void write_waypoint(ByteWriter& to, const Waypoint<Space>& waypoint, Fields fields) {
  to.f64(waypoint.time_s);
  const auto* const numbers = reinterpret_cast<const double*>(&waypoint.point);
  for (int i = 0; i < Space::numbers(fields); ++i) to.f64(numbers[i]);
}

template <class Space>
Waypoint<Space> read_waypoint(ByteReader& from, Fields fields) {
  Waypoint<Space> waypoint;
  waypoint.time_s = from.f64();
  auto* const numbers = reinterpret_cast<double*>(&waypoint.point);
  for (int i = 0; i < Space::numbers(fields); ++i) numbers[i] = from.f64();
  return waypoint;
}

template void write_waypoint(ByteWriter&, const Waypoint<JointSpace>&, Fields);
template void write_waypoint(ByteWriter&, const Waypoint<TaskSpace>&, Fields);
template Waypoint<JointSpace> read_waypoint<JointSpace>(ByteReader&, Fields);
template Waypoint<TaskSpace> read_waypoint<TaskSpace>(ByteReader&, Fields);

void write_verdict(ByteWriter& to, const Verdict& verdict) {
  to.u8(static_cast<std::uint8_t>(verdict.status));
  to.i32(verdict.waypoint);
  to.i32(verdict.axis);
  to.f64(verdict.value);
  to.f64(verdict.limit);
}

Verdict read_verdict(ByteReader& from) {
  Verdict verdict;
  verdict.status = static_cast<Status>(from.u8());
  verdict.waypoint = from.i32();
  verdict.axis = from.i32();
  verdict.value = from.f64();
  verdict.limit = from.f64();
  return verdict;
}

void write_report(ByteWriter& to, const Report& report) {
  to.u32(report.id);
  to.u8(static_cast<std::uint8_t>(report.outcome));
  write_verdict(to, report.verdict);
  to.f64(report.time_s);
}

Report read_report(ByteReader& from) {
  Report report;
  report.id = from.u32();
  report.outcome = static_cast<Outcome>(from.u8());
  report.verdict = read_verdict(from);
  report.time_s = from.f64();
  return report;
}

}  // namespace tactus
