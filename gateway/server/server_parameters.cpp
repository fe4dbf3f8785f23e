// Server: parameters of the pipeline that runs.
#include "gateway/server/parameter_texts.hpp"
#include "gateway/server/server.hpp"
#include "gateway/verdict_text.hpp"

namespace tactus {
namespace {

constexpr int kPerPage = 3;  // tactus.options

template <class Field>
std::string_view text_of(const Field& field) {
  return {reinterpret_cast<const char*>(field.bytes), field.size};
}

/// Why the cycle refuses a set, and what to do.
Message refusal(const Pipeline& pipeline, const TuningVerdict& verdict) {
  Message text;
  if (verdict.block >= 0) text << "[" << std::string_view(pipeline.name(verdict.block)) << "] ";
  switch (verdict.status) {
    case Status::kEffortLimit:
      return text << "with these parameters the law would now ask for too much: "
                  << describe(verdict, VerdictAxes::kJoints)
                  << "; take smaller steps, or set them with the arm at its reference";
    case Status::kNotAtRest:
      return text << "the arm is being brought to rest; set them when it rests";
    case Status::kArming: return text << "drives are being armed; set them when that is done";
    default: return text << describe(verdict.status);
  }
}

}  // namespace

/// Takes a set; it is the cycle's until take_tuned().
Reply Server::parameters(const Origin& from) {
  const tactus_Parameters& request = request_.request.parameters;
  ParameterBook& book = *setup_.parameters;
  if (tuning_)
    return {Status::kMailboxFull,
            "a set of parameters is under way; send it again after its Report"};
  std::array<ParameterText, sizeof request.set / sizeof request.set[0]> set;
  for (pb_size_t i = 0; i < request.set_count; ++i)
    set[i] = {text_of(request.set[i].section), text_of(request.set[i].key),
              text_of(request.set[i].value)};
  LoadError error;
  if (book.prepare(set.data(), request.set_count, error) != Status::kOk)
    return {error.status, error.message()};
  if (request.check) {
    book.drop();
    return {};
  }
  if (!mail_.tunings.post({&book.tuning()})) {
    book.drop();
    return {Status::kMailboxFull, "the cycle has not yet taken the last set; send it again"};
  }
  tuning_ = true;
  tuning_from_ = from;
  tuning_by_ = at(from.slot).name;
  return {};
}

/// Sends a page; a client that asks for more than its space holds is told to read.
Reply Server::list_parameters(const Origin& from) {
  ParameterBook& book = *setup_.parameters;
  const std::uint32_t first = request_.request.list_parameters.first;
  const int total = count_parameters(book);
  if (first > static_cast<std::uint32_t>(total)) {
    Message text("ListParameters.first is ");
    return {Status::kBadValue,
            text << static_cast<double>(first) << "; there are " << total << " parameters"};
  }
  told_ = tactus_ToClient_init_zero;
  told_.which_message = tactus_ToClient_parameter_page_tag;
  tactus_ParameterPage& page = told_.message.parameter_page;
  page.number = from.number;
  page.first = first;
  page.total = static_cast<std::uint32_t>(total);
  page.sets = parameter_sets_;
  PresentParameter now, file;
  for (int i = static_cast<int>(first); i < total && page.parameters_count < kPerPage; ++i) {
    parameter_at(book, ParameterBook::Copy::kPresent, i, now);
    parameter_at(book, ParameterBook::Copy::kOfFile, i, file);
    tactus_PresentParameter& to = page.parameters[page.parameters_count++];
    set_text(to.section, now.section);
    set_text(to.key, now.key);
    set_text(to.value, now.value);
    set_text(to.unit, now.unit);
    set_text(to.range, now.range);
    if (std::string_view(now.value) != file.value) set_text(to.file_value, file.value);
    to.tunable = now.tunable;
  }
  if (put(at(from.slot))) return {};
  return {Status::kMailboxFull, "there is no space for the page; read what is sent, and ask again"};
}

/// Tells everybody what a set has changed.
void Server::tell_changes(std::int64_t now_ns) {
  ParameterBook& book = *setup_.parameters;
  PresentParameter before, after;
  for (int i = 0; parameter_at(book, ParameterBook::Copy::kPresent, i, before); ++i) {
    parameter_at(book, ParameterBook::Copy::kNext, i, after);
    if (std::string_view(before.value) == after.value) continue;
    PlacedMessage text("[");
    text << before.section << "] " << before.key << ": " << std::string_view(before.value) << " -> "
         << std::string_view(after.value);
    text << ", by " << std::string_view(tuning_by_);
    if (setup_.log != nullptr) setup_.log(text.c_str());
    tell_events("parameter", Status::kOk, text, -1, now_ns);
  }
}

void Server::take_tuned(std::int64_t now_ns) {
  TuningVerdict verdict;
  if (!tuning_ || !mail_.tuned.take(verdict)) return;
  tuning_ = false;
  const bool good = verdict.status == Status::kOk;
  Message text;
  if (good) {
    ++parameter_sets_;
    tell_changes(now_ns);
    setup_.parameters->commit();
  } else {
    setup_.parameters->drop();
    text = refusal(*setup_.loaded, verdict);
  }
  report({tuning_from_,
          good ? Outcome::kExecuted : Outcome::kRefused,
          {verdict.status},
          newest_.time_s,
          0.0},
         text, now_ns);
}

}  // namespace tactus
