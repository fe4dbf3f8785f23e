#include "boards/bare_metal/messages.hpp"

namespace bare {

using namespace tactus;
using serial::Kind;

void Messages::answer(const Verdict& verdict, std::uint32_t id) {
  ByteWriter& to = link_.answer(verdict.status);
  write_verdict(to, verdict);
  to.u32(id);
}

void Messages::execute_reference(const serial::Frame& frame) {
  ByteReader payload(frame.payload, frame.size);
  TrajectoryTerms terms;
  std::uint32_t id = 0;
  switch (frame.kind) {
    case Kind::kTrajectory:
      if (!read_terms(payload, terms)) return answer(Status::kWireFormat);
      poses_ = terms.poses;
      return answer(with_references(poses_, [&](auto& to) { return to.begin(terms); }), 0);
    case Kind::kWaypoints: return take_waypoints(payload);
    case Kind::kEnd: {
      const Verdict verdict = with_references(poses_, [&](auto& to) { return to.end(id); });
      return answer(verdict, id);
    }
    case Kind::kPoint: return send_point(payload);
    case Kind::kControl: return control(payload);
    case Kind::kReports: return give_reports();
    default: return answer(Status::kNotOffered);
  }
}

void Messages::take_waypoints(ByteReader payload) {
  const int count = payload.u8();
  int taken = 0;
  const Verdict verdict =
      with_references(poses_, [&](auto& to) { return to.take(payload, count, taken); });
  answer(verdict, static_cast<std::uint32_t>(taken));
}

void Messages::send_point(ByteReader payload) {
  TrajectoryTerms terms;
  std::uint32_t id = 0;
  const std::size_t size = payload.u8();
  ByteReader head(reinterpret_cast<const std::uint8_t*>(payload.text(size).data()), size);
  if (!payload.ok() || !read_terms(head, terms)) return answer(Status::kWireFormat);
  const Verdict verdict =
      with_references(terms.poses, [&](auto& to) { return to.point(terms, payload, id); });
  answer(verdict, id);
}

void Messages::control(ByteReader payload) {
  const std::uint8_t space = payload.u8();
  const auto kind = static_cast<ControlKind>(payload.u8());
  const double rate = payload.f64();
  std::uint32_t id = 0;
  if (!payload.done() || space > 1) return answer(Status::kWireFormat);
  const Verdict verdict =
      with_references(space == 1, [&](auto& to) { return to.control(kind, rate, id); });
  answer(verdict, id);
}

void Messages::give_reports() {
  constexpr int kMost = 16;  // of one answer
  ByteWriter& to = link_.answer(Status::kOk);
  for (int i = 0; i < kMost && machine_->reports() > 0; ++i)
    write_report(to, machine_->next_report());
}

}  // namespace bare
