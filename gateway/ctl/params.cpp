// The verb params: lists the parameters of the pipeline, checks a set of them, or has it take
// effect.
#include <algorithm>

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

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(width > text.size() ? width - text.size() : 0, ' ');
}

/// One line for people: what, value, unit, limits, and how it differs from the file.
void say(Output& output, const PresentParameter& one) {
  const std::string place = one.section() + "." + one.key();
  std::string line = std::string(one.tunable() ? "* " : "  ") + padded(place, 36) + " " +
                     (one.value().empty() ? "-" : one.value());
  if (!one.unit().empty() && one.unit() != "1") line += " " + one.unit();
  if (!one.range().empty()) line += "   (" + one.range() + ")";
  if (!one.file_value().empty()) line += "   file: " + one.file_value();
  output.say(printed(line));
}

/// Asks for one page after the other.
int list(Session& session) {
  std::vector<PresentParameter> all;
  std::uint32_t total = 1;
  session.client.on_message = [&](const ToClient& message) {
    if (!message.has_parameter_page()) return;
    total = message.parameter_page().total();
    for (const PresentParameter& one : message.parameter_page().parameters()) all.push_back(one);
  };
  for (std::size_t before = 0; all.size() < total; before = all.size()) {
    ToServer request;
    request.mutable_list_parameters()->set_first(static_cast<std::uint32_t>(all.size()));
    if (!session.client.ask(request)) return session.client.exit_code();
    if (all.size() == before) break;
  }
  for (const PresentParameter& one : all) {
    session.output.object("parameter", one);
    say(session.output, one);
  }
  session.output.say("* may change while the pipeline runs");
  return session.client.exit_code();
}

}  // namespace

int params(Session& session) {
  if (!offers(session.client.welcome(), FEATURE_PARAMETERS)) {
    session.client.refuse(
        "the server takes no parameters; change the pipeline file and start the server again");
    return session.client.exit_code();
  }
  const std::vector<std::string>& settings = session.options.settings;
  if (settings.empty()) return list(session);
  ToServer request;
  request.add_requires(FEATURE_PARAMETERS);
  Parameters& parameters = *request.mutable_parameters();
  parameters.set_check(session.options.check_only);
  for (const std::string& text : settings) {
    if (read_setting(text, *parameters.add_set())) continue;
    session.client.refuse("'" + text + "' is no setting; write section.key=value");
    return session.client.exit_code();
  }
  if (!session.options.check_only && !session.client.take_lease())
    return session.client.exit_code();
  session.client.ask_and_wait(request);
  session.client.release_lease();
  return session.client.exit_code();
}

}  // namespace tactus::ctl
