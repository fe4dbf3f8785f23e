// The verbs that are one message and its report: cancel, override, pause, resume, stop, rearm,
// tare.
#include "gateway/ctl/verbs.hpp"

namespace tactus::ctl {
namespace {

void fill(const Session& session, ToServer& request) {
  switch (session.options.verb) {
    case Verb::kCancel: request.mutable_cancel(); return;
    case Verb::kOverride:
      request.mutable_override()->set_rate(session.options.rate);
      request.mutable_override()->set_stops(session.client.stops());
      return;
    case Verb::kPause: request.mutable_pause(); return;
    case Verb::kResume: request.mutable_resume()->set_stops(session.client.stops()); return;
    case Verb::kRearm: request.mutable_rearm()->set_stops(session.client.stops()); return;
    case Verb::kTare:
      request.mutable_tare();
      request.add_requires(FEATURE_TARE);
      return;
    default: request.mutable_stop();
  }
}

/// Takes the lease that a verb needs. A verb that only slows the arm down needs none; an override
/// may, if it makes it faster.
bool prepare(Session& session) {
  switch (session.options.verb) {
    case Verb::kStop:
    case Verb::kCancel:
    case Verb::kPause: return true;
    case Verb::kOverride: return session.client.take_free_lease();
    default: return session.client.take_lease();
  }
}

}  // namespace

int control(Session& session) {
  if (session.options.verb == Verb::kTare && !offers(session.client.welcome(), FEATURE_TARE)) {
    session.client.refuse("the pipeline has no wrench_front_end, or more than one");
    return session.client.exit_code();
  }
  ToServer request;
  fill(session, request);
  if (!prepare(session)) return session.client.exit_code();
  session.client.ask_and_wait(request);
  session.client.release_lease();
  return session.client.exit_code();
}

}  // namespace tactus::ctl
