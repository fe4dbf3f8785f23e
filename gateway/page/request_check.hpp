// Checks of a browser's request before it is served. A browser runs the scripts of every page that
// is open in it; the checks keep out those of other pages:
//
//   Host    a name of this computer's own, so that no name of elsewhere can be made to lead here
//           (DNS rebinding)
//   Origin  if given, the page's own; none of the headers twice
//   token   drawn at the start and told to the page only; whatever acts or takes a place gives it
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace tactus {

struct RequestHead {
  std::string_view method = {}, path = {};
  std::string_view host = {};                   ///< empty if it is missing
  std::optional<std::string_view> origin = {};  ///< an empty one is none of ours
  std::string_view token = {};                  ///< of the header X-Tactus-Token, or of the query
  std::string_view seen = {};                   ///< of the header X-Tactus-Seen
  bool repeated = false;                        ///< one of these headers occurs twice
};

/// Takes a header of the request; names are compared without case. [any]
void take_header(std::string_view name, std::string_view value, RequestHead& head);

/// Time and stop count of the newest state that a browser has received.
struct SeenState {
  std::int64_t sent_ms = -1;  ///< when it was sent; -1: not given
  std::uint32_t stops = 0;    ///< number of the latest stop in it
};

/// Writes and reads it, "12345 6". [any]
std::string_view write_seen(const SeenState& seen, std::array<char, 32>& to);
SeenState read_seen(std::string_view text);

enum class PagePath : unsigned char {
  kNone,  ///< refused
  kFile,
  kDescription,
  kEvents,
  kCommand,
};

struct RequestVerdict {
  int status = 200;       ///< of HTTP; 200: go on
  const char* text = "";  ///< of a refusal
  PagePath path = PagePath::kNone;
};

/// Judges a request by its head. [any]
RequestVerdict judge_request(const RequestHead& head, std::string_view token);

/// True if `host`, of the header Host, names this computer itself, at any port: a forwarded one
/// differs from ours. [any]
bool own_host(std::string_view host);

}  // namespace tactus
