#include "gateway/page/page_command.hpp"

#include <array>
#include <charconv>

namespace tactus {
namespace {

struct Named {
  std::string_view path;
  PageCommand command;
};
constexpr std::array<Named, 7> kCommands = {{
    {"/stop", PageCommand::kStop},
    {"/override", PageCommand::kOverride},
    {"/cancel", PageCommand::kCancel},
    {"/pause", PageCommand::kPause},
    {"/resume", PageCommand::kResume},
    {"/rearm", PageCommand::kRearm},
    {"/tare", PageCommand::kTare},
}};

constexpr pb_size_t tag_of(PageCommand command) {
  switch (command) {
    case PageCommand::kStop: return tactus_ToServer_stop_tag;
    case PageCommand::kOverride: return tactus_ToServer_override_tag;
    case PageCommand::kCancel: return tactus_ToServer_cancel_tag;
    case PageCommand::kPause: return tactus_ToServer_pause_tag;
    case PageCommand::kResume: return tactus_ToServer_resume_tag;
    case PageCommand::kRearm: return tactus_ToServer_rearm_tag;
    case PageCommand::kTare: return tactus_ToServer_tare_tag;
  }
  return 0;
}

}  // namespace

bool command_of(std::string_view path, PageCommand& command) {
  for (const Named& named : kCommands) {
    if (named.path != path) continue;
    command = named.command;
    return true;
  }
  return false;
}

bool read_body(PageCommand command, std::string_view body, double& rate) {
  if (command != PageCommand::kOverride) return body.empty();
  const char* const end = body.data() + body.size();
  const auto [stop, error] = std::from_chars(body.data(), end, rate);
  return error == std::errc() && stop == end && rate >= 0.0 && rate <= 1.0;
}

void write_request(PageCommand command, double rate, std::uint32_t stops,
                   tactus_ToServer& message) {
  message.which_request = tag_of(command);
  if (command == PageCommand::kOverride) message.request.override = {rate, stops};
  if (command == PageCommand::kResume) message.request.resume.stops = stops;
  if (command == PageCommand::kRearm) message.request.rearm.stops = stops;
}

}  // namespace tactus
