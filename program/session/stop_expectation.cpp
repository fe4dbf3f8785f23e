#include "program/session/stop_expectation.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "gateway/verdict_text.hpp"
#include "kernel/guard/collision_section.hpp"
#include "kernel/load/ini.hpp"

namespace tactus {
namespace {

/// Returns why the collision check cannot stop the arm before these two meet; empty if it can.
Message refusal(std::string_view pair, std::string_view first, std::string_view second,
                std::string_view rest, const CollisionSection& section) {
  if (second.empty() || !rest.empty() || first == second)
    return Message("'") << pair << "' is not a pair of names, as in: tool table";
  if (!section.present) return Message("there is no [collision], which would stop the arm");
  const auto begin = section.scene.names.begin(), end = begin + section.scene.body_count;
  for (const std::string_view name : {first, second})
    if (std::find(begin, end, name) == end)
      return Message("unknown body '") << name << "'; its names are those of [collision] allow";
  const auto a = std::find(begin, end, first) - begin, b = std::find(begin, end, second) - begin;
  const bool boxes = std::min(a, b) >= kFirstBoxBody;
  const bool neighbours = std::max(a, b) <= kToolBody && std::abs(a - b) == 1;
  if (boxes || neighbours)
    return Message("[collision] does not check ") << first << " against " << second;
  return {};
}

}  // namespace

bool StopExpectation::start(std::string_view pair, const Pipeline& pipeline, const char* path) {
  *this = {};
  if (pair.empty()) return true;
  std::string_view rest = pair;
  const std::string_view first = take_word(rest), second = take_word(rest);
  const Message why = refusal(pair, first, second, trim(rest), pipeline.collision);
  first_ = Name(first);
  second_ = Name(second);
  if (!why.empty()) std::fprintf(stderr, "%s: [expect] collision_stop: %s\n", path, why.c_str());
  return why.empty();
}

void StopExpectation::take(Status fault, const Collision::Telemetry& contact, bool at_rest) {
  const std::string_view a = first_, b = second_;
  const bool of_pair =
      (a == contact.first && b == contact.second) || (a == contact.second && b == contact.first);
  if (fault == Status::kOk)
    seen_ = Message("not stopped");
  else if (fault != Status::kCollision)
    seen_ = Message("stopped by ") << describe(fault);
  else
    seen_ = Message("stopped ") << (of_pair ? before(a, b) : before(contact.first, contact.second));
  if (fault != Status::kOk && !at_rest) seen_ << ", not at rest";
  met_ = fault == Status::kCollision && of_pair && at_rest;
}

}  // namespace tactus
