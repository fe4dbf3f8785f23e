// PageCommand: a request that a browser sends by POST, and its message to the gateway.
#pragma once

#include <string_view>

#include "gateway/server/codec.hpp"

namespace tactus {

enum class PageCommand : unsigned char {
  kStop,
  kOverride,
  kCancel,
  kPause,
  kResume,
  kRearm,
  kTare
};

/// Finds the command of a path, "/stop". False: there is none. [any]
bool command_of(std::string_view path, PageCommand& command);

/// Reads the body: a rate from 0 to 1 for kOverride, nothing for the others. False: it is something
/// else. [any]
bool read_body(PageCommand command, std::string_view body, double& rate);

/// Sets the request of a message; its number is left alone. `stops`: that its sender had been told
/// of. [any]
void write_request(PageCommand command, double rate, std::uint32_t stops, tactus_ToServer& message);

/// True if the gateway takes it from the owner of the lease only; an override if it is a higher
/// one. [any]
constexpr bool may_need_lease(PageCommand command) {
  return command == PageCommand::kOverride || command == PageCommand::kResume ||
         command == PageCommand::kRearm || command == PageCommand::kTare;
}

}  // namespace tactus
