#include "sim_plant/drives/server/fault_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace tactus::drives {
namespace {

constexpr double kMaxNode = 127.0, kMaxSyncs = 1e15, kMaxValue = 4294967295.0;

bool parse_kind(std::string_view text, const FaultNames& names, std::size_t& kind) {
  for (kind = 0; kind < names.count; ++kind)
    if (text == names.names[kind]) return true;
  return false;
}

/// A whole number within the range.
bool parse_whole(const char* text, std::size_t size, double highest, double& value) {
  char* end = nullptr;
  value = std::strtod(text, &end);
  return end == text + size && value >= 0.0 && value <= highest && std::floor(value) == value;
}

const char* parse_word(std::string_view key, std::string_view text, const FaultNames& names,
                       std::size_t& kind, Fault& fault) {
  double value = 0.0;
  const char* begin = text.data();
  if (key == "kind")
    return parse_kind(text, names, kind) ? nullptr : "unknown kind of fault; --help names them";
  if (key == "node") {
    if (!parse_whole(begin, text.size(), kMaxNode, value)) return "node is not from 0 to 127";
    fault.node = static_cast<int>(value);
  } else if (key == "at" || key == "until") {
    if (!parse_whole(begin, text.size(), kMaxSyncs, value)) return "not a count of SYNCs";
    (key == "at" ? fault.at : fault.until) = static_cast<std::int64_t>(value);
  } else if (key == "value") {
    if (!parse_whole(begin, text.size(), kMaxValue, value)) return "value is not a 32-bit number";
    fault.value = static_cast<std::uint32_t>(value);
  } else if (key == "p") {
    char* end = nullptr;
    fault.probability = std::strtod(begin, &end);
    const bool good = fault.probability > 0.0 && fault.probability <= 1.0;
    if (end != begin + text.size() || !good) return "p is not a probability";
  } else {
    return "unknown key; expected node, kind, at, until, value or p";
  }
  return nullptr;
}

}  // namespace

const char* parse_fault(const char* text, Fault& fault) {
  std::size_t kind = 0;
  const char* const wrong =
      parse_fault(text, {kFaultNames.data(), kFaultNames.size()}, kind, fault);
  fault.kind = static_cast<FaultKind>(kind);
  return wrong;
}

const char* parse_fault(const char* text, const FaultNames& names, std::size_t& kind,
                        Fault& fault) {
  bool has_kind = false;
  std::string_view rest = text;
  while (!rest.empty()) {
    if (rest.front() == ' ') {
      rest.remove_prefix(1);
      continue;
    }
    const std::size_t size = std::min(rest.find(' '), rest.size());
    const std::string_view word = rest.substr(0, size);
    const std::size_t equals = word.find('=');
    if (equals == std::string_view::npos || equals + 1 == word.size())
      return "expected words like key=value";
    const std::string_view key = word.substr(0, equals);
    const char* wrong = parse_word(key, word.substr(equals + 1), names, kind, fault);
    if (wrong != nullptr) return wrong;
    has_kind = has_kind || key == "kind";
    rest.remove_prefix(size);
  }
  return has_kind ? nullptr : "the kind is missing";
}

}  // namespace tactus::drives
