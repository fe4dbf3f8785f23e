// The verbs that are one message and its report: cancel, override, pause, resume, stop, rearm,
// params.
#include "gateway/ctl/verbs.hpp"

namespace tactus::ctl {
namespace {

/// Takes "section.key=value" apart. False: it is something else.
bool read_setting(const std::string& text, Parameter& parameter) {
  const std::size_t equals = text.find('=');
  const std::size_t dot = text.rfind('.', equals);
  if (equals == std::string::npos || dot == std::string::npos || dot == 0) return false;
  parameter.set_section(text.substr(0, dot));
  parameter.set_key(text.substr(dot + 1, equals - dot - 1));
  parameter.set_value(text.substr(equals + 1));
  return !parameter.key().empty();
}

bool fill_parameters(Session& session, ToServer& request) {
  Parameters& parameters = *request.mutable_parameters();
  request.add_requires(FEATURE_PARAMETERS);
  parameters.set_check(session.options.check_only);
  for (const std::string& text : session.options.settings)
    if (!read_setting(text, *parameters.add_set()))
      return session.client.refuse("'" + text + "' is no setting; write section.key=value");
  if (offers(session.client.welcome(), FEATURE_PARAMETERS)) return true;
  return session.client.refuse(
      "the server takes no parameters; change the pipeline file and start the server again");
}

bool fill(Session& session, ToServer& request) {
  switch (session.options.verb) {
    case Verb::kCancel: request.mutable_cancel(); return true;
    case Verb::kOverride: request.mutable_override()->set_rate(session.options.rate); return true;
    case Verb::kPause: request.mutable_pause(); return true;
    case Verb::kResume: request.mutable_resume(); return true;
    case Verb::kRearm: request.mutable_rearm(); return true;
    case Verb::kParams: return fill_parameters(session, request);
    default: request.mutable_stop(); return true;
  }
}

/// Takes the lease that a verb needs. What only slows the arm down needs none; an override may, if
/// it makes it faster.
bool prepare(Session& session) {
  switch (session.options.verb) {
    case Verb::kStop:
    case Verb::kCancel:
    case Verb::kPause: return true;
    case Verb::kOverride: return session.client.take_free_lease();
    default: return session.options.check_only || session.client.take_lease();
  }
}

}  // namespace

int control(Session& session) {
  ToServer request;
  if (!fill(session, request)) return session.client.exit_code();
  if (!prepare(session)) return session.client.exit_code();
  session.client.ask_and_wait(request);
  session.client.release_lease();
  return session.client.exit_code();
}

}  // namespace tactus::ctl
