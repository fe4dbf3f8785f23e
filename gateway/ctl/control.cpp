// The verbs that are one message and its report: cancel, override, pause, resume, stop, rearm.
#include "gateway/ctl/verbs.hpp"

namespace tactus::ctl {
namespace {

void fill(const Session& session, ToServer& request) {
  switch (session.options.verb) {
    case Verb::kCancel: request.mutable_cancel(); return;
    case Verb::kOverride: request.mutable_override()->set_rate(session.options.rate); return;
    case Verb::kPause: request.mutable_pause(); return;
    case Verb::kResume: request.mutable_resume(); return;
    case Verb::kRearm: request.mutable_rearm(); return;
    default: request.mutable_stop();
  }
}

}  // namespace

int control(Session& session) {
  ToServer request;
  fill(session, request);
  const bool needs_lease = session.options.verb != Verb::kStop;
  if (needs_lease && !session.client.take_lease()) return session.client.exit_code();
  session.client.ask_and_wait(request);
  session.client.release_lease();
  return session.client.exit_code();
}

}  // namespace tactus::ctl
