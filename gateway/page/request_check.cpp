#include "gateway/page/request_check.hpp"

#include <algorithm>
#include <charconv>

#include "gateway/page/page_command.hpp"
#include "gateway/page/page_files.hpp"

namespace tactus {
namespace {

constexpr std::string_view kScheme = "http://";

/// Compares in a time that does not tell where they differ.
bool same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned>(a[i]) ^ static_cast<unsigned>(b[i]);
  return difference == 0;
}

bool own_origin(std::string_view origin, std::string_view host) {
  if (origin.compare(0, kScheme.size(), kScheme) != 0) return false;
  return origin.substr(kScheme.size()) == host;
}

constexpr char lower(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char one, char other) { return lower(one) == lower(other); });
}

PagePath find(std::string_view path) {
  if (path == "/robot.json") return PagePath::kDescription;
  if (path == "/events") return PagePath::kEvents;
  if (page_file(path) != nullptr) return PagePath::kFile;
  PageCommand command;
  return command_of(path, command) ? PagePath::kCommand : PagePath::kNone;
}

}  // namespace

void take_header(std::string_view name, std::string_view value, RequestHead& head) {
  if (same_name(name, "Origin")) {
    head.repeated |= head.origin.has_value();
    head.origin = value;
  }
  const auto take = [&](std::string_view its, std::string_view& to) {
    if (!same_name(name, its)) return;
    head.repeated |= to.data() != nullptr;
    to = value;
  };
  take("Host", head.host);
  take("X-Tactus-Token", head.token);
  take("X-Tactus-Seen", head.seen);
}

std::string_view write_seen(const SeenState& seen, std::array<char, 32>& to) {
  char* const end = to.data() + to.size();
  char* at = std::to_chars(to.data(), end, seen.sent_ms).ptr;
  *at++ = ' ';
  at = std::to_chars(at, end, seen.stops).ptr;
  return {to.data(), static_cast<std::size_t>(at - to.data())};
}

SeenState read_seen(std::string_view text) {
  SeenState seen;
  const char* const end = text.data() + text.size();
  const auto [blank, error] = std::from_chars(text.data(), end, seen.sent_ms);
  if (error != std::errc() || blank == end || *blank != ' ') return {};
  const auto [stop, other] = std::from_chars(blank + 1, end, seen.stops);
  return other == std::errc() && stop == end ? seen : SeenState{};
}

bool own_host(std::string_view host) {
  const std::size_t colon = host.rfind(':');
  const std::string_view port =
      colon == std::string_view::npos ? std::string_view() : host.substr(colon + 1);
  if (port.find_first_not_of("0123456789") != std::string_view::npos) return false;
  const std::string_view name = host.substr(0, colon);
  return name == "127.0.0.1" || name == "localhost";
}

RequestVerdict judge_request(const RequestHead& head, std::string_view token) {
  if (head.repeated) return {400, "a header that is checked comes twice"};
  if (!own_host(head.host)) return {403, "the Host is neither 127.0.0.1 nor localhost"};
  if (head.origin && !own_origin(*head.origin, head.host))
    return {403, "the Origin is another page"};
  const PagePath path = find(head.path);
  if (path == PagePath::kNone) return {404, "there is no such path"};
  const bool command = path == PagePath::kCommand;
  if (head.method != (command ? "POST" : "GET"))
    return {405, command ? "commands are sent by POST" : "this is read by GET"};
  const bool secret = command || path == PagePath::kEvents;
  if (secret && !same_secret(head.token, token))
    return {403, "the token is not this server's; load the page again"};
  return {200, "", path};
}

}  // namespace tactus
