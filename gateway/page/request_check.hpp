// What the page takes of a browser's request before anything is done for it. A browser runs the
// scripts of any page that is open in it; the checks keep those of other pages out:
//
//   Host    a name of this computer's own, so that no name of elsewhere can be made to lead here
//           (DNS rebinding)
//   Origin  if given, the page's own
//   token   drawn at the start and told to the page only; whatever acts or takes a place gives it
#pragma once

#include <string_view>

namespace tactus {

/// A header that is missing is empty.
struct RequestHead {
  std::string_view method, path, host, origin;
  std::string_view token;  ///< of the header X-Tactus-Token, or of the query
};

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
