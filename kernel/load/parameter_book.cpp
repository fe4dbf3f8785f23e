#include "kernel/load/parameter_book.hpp"

#include <new>

#include "kernel/load/parameter_reader.hpp"

namespace tactus {
namespace {

template <class Kind, class = void>
constexpr bool kJudges = false;
template <class Kind>
constexpr bool kJudges<Kind, std::void_t<decltype(&Kind::judge)>> = true;

/// Judges the parameters of a block together, as its start() does.
template <class Kind>
Status judge_block(const Kind& block, double period_s) {
  if constexpr (!kJudges<Kind>)
    return Status::kOk;
  else if constexpr (std::is_invocable_v<decltype(&Kind::judge), const Kind&, double>)
    return block.judge(period_s);
  else
    return block.judge();
}

/// The remedy for parameters that do not fit together.
const char* remedy(Status status) {
  switch (status) {
    case Status::kUnstableGain:
      return "; every gain times (period + measurement_delay) must be at most 0.5";
    case Status::kNotConnected:
      return "; a feed-forward gain must be 0 unless the pipeline file wires its input";
    case Status::kBadValue:
      return "; a damping ratio needs stiffness above 0 on every compliant axis";
    default: return "";
  }
}

/// False if a value contains a character that no value of a file has.
bool is_plain(std::string_view value) {
  for (const char c : value)
    if (static_cast<unsigned char>(c) >= 0x80 || c == '#') return false;
  return is_text(value);
}

bool is_earlier(const ParameterText* set, int i, std::string_view section) {
  for (int k = 0; k < i; ++k)
    if (set[k].section == section) return true;
  return false;
}

}  // namespace

ParameterBook::ParameterBook(Pipeline& pipeline) : pipeline_(pipeline) {
  for (Places& places : copies_) {
    for (int i = 0; i < pipeline.count(); ++i) {
      with_block(pipeline[i], [&](const auto& block) {
        using Kind = std::decay_t<decltype(block)>;
        if constexpr (kTunes<Kind>) new (places[static_cast<std::size_t>(i)].bytes) Kind(block);
      });
    }
  }
}

Block ParameterBook::block(Copy which, int i) {
  Block block = pipeline_[i];
  with_block(block, [&](const auto& its) {
    if constexpr (kTunes<std::decay_t<decltype(its)>>)
      block.place = copies_[static_cast<std::size_t>(which)][static_cast<std::size_t>(i)].bytes;
  });
  return block;
}

void ParameterBook::copy(Copy from, Copy to) {
  for (int i = 0; i < pipeline_.count(); ++i) {
    const Block source = block(from, i);
    with_block(block(to, i), [&](auto& its) {
      using Kind = std::decay_t<decltype(its)>;
      if constexpr (kTunes<Kind>) its.params = static_cast<const Kind*>(source.place)->params;
    });
  }
  tuning_ = {};
}

Status ParameterBook::prepare(const ParameterText* set, int count, LoadError& error) {
  error = {};
  Ini ini;
  TRY(fill(set, count, ini, error));
  drop();
  Status status = Status::kOk;
  for (int i = 0; i < ini.section_count() && status == Status::kOk; ++i)
    status = read(ini, ini.section(i), error);
  if (status != Status::kOk) drop();
  return status;
}

/// Makes the sections of a file of a set, with the keys of each together.
Status ParameterBook::fill(const ParameterText* set, int count, Ini& ini, LoadError& error) const {
  if (count == 0)
    return error.refuse(Status::kMissingKey, 0, {}, {},
                        "the set is empty; give section, key and value of a parameter");
  for (int i = 0; i < count; ++i) {
    const std::string_view section = set[i].section;
    if (is_earlier(set, i, section)) continue;
    TRY(ini.add_section(section, 0, error));
    const IniSection& added = *ini.find(section);
    for (int k = i; k < count; ++k) {
      if (set[k].section != section) continue;
      if (ini.find(added, set[k].key) != nullptr)
        return error.refuse(Status::kDuplicate, 0, section, set[k].key,
                            "the set has it twice; give it once");
      if (!is_plain(set[k].value))
        return error.refuse(Status::kBadSyntax, 0, section, {},
                            "the value contains bytes that are not text, or '#'");
      TRY(ini.add_entry(set[k].key, trim(set[k].value), 0, error));
    }
  }
  return Status::kOk;
}

/// Reads one section into the next copy of its block.
Status ParameterBook::read(const Ini& ini, const IniSection& section, LoadError& error) {
  bool found = false;
  each_section(Copy::kNext, [&](std::string_view name, auto& described) {
    if (name == section.name && !found) {
      found = true;
      ParameterReader reader(ini, section, pipeline_.ports, error,
                             kTunes<std::decay_t<decltype(described)>>);
      while (reader.next()) {
        reader.fixed("type");
        described.describe(reader);
      }
    }
  });
  if (!found) return refuse_unknown(section.name, error);
  if (error.status != Status::kOk) return error.status;
  for (int b = 0; b < pipeline_.count(); ++b)
    if (std::string_view(pipeline_.name(b)) == section.name) return judge(b, error);
  return Status::kOk;
}

/// Judges what was read for a block, and puts it into the tuning.
Status ParameterBook::judge(int i, LoadError& error) {
  const Block next = block(Copy::kNext, i);
  const double period_s = pipeline_.robot.period_s();
  const Status status =
      with_block(next, [period_s](const auto& its) { return judge_block(its, period_s); });
  if (status != Status::kOk)
    return error.refuse(status, 0, pipeline_.name(i), {},
                        Message(meaning(status)) << remedy(status));
  tuning_.copies[static_cast<std::size_t>(i)] = next.place;
  return Status::kOk;
}

Status ParameterBook::refuse_unknown(std::string_view section, LoadError& error) {
  Message reason("no section of this name has parameters here; these have:");
  const char* before = " ";
  each_section(Copy::kPresent, [&](std::string_view name, auto& /*described*/) {
    reason << before << name;
    before = ", ";
  });
  return error.refuse(Status::kUnknownKey, 0, section, {}, reason);
}

}  // namespace tactus
