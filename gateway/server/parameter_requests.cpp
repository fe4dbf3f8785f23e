#include "gateway/server/parameter_requests.hpp"

#include "gateway/server/parameter_texts.hpp"

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

Reply ParameterRequests::set(const tactus_Parameters& request, const Origin& from) {
  ParameterBook& book = *book_;
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
  if (!mailboxes_.tunings.post({&book.tuning()})) {
    book.drop();
    return {Status::kMailboxFull, "the cycle has not yet taken the last set; send it again"};
  }
  tuning_ = true;
  from_ = from;
  by_ = clients_.at(from.slot).name;
  return {};
}

Reply ParameterRequests::list(const tactus_ListParameters& request, const Origin& from) {
  ParameterBook& book = *book_;
  const std::uint32_t first = request.first;
  const int total = count_parameters(book);
  if (first > static_cast<std::uint32_t>(total)) {
    Message text("ListParameters.first is ");
    return {Status::kBadValue,
            text << static_cast<double>(first) << "; there are " << total << " parameters"};
  }
  tactus_ParameterPage& page =
      clients_.begin_message(tactus_ToClient_parameter_page_tag).message.parameter_page;
  page.number = from.number;
  page.first = first;
  page.total = static_cast<std::uint32_t>(total);
  page.sets = sets_;
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
  if (clients_.put(clients_.at(from.slot))) return {};
  return {Status::kMailboxFull, "there is no space for the page; read what is sent, and ask again"};
}

/// Sends the changes of a set to all clients.
void ParameterRequests::send_changes(std::int64_t now_ns) {
  ParameterBook& book = *book_;
  PresentParameter before, after;
  for (int i = 0; parameter_at(book, ParameterBook::Copy::kPresent, i, before); ++i) {
    parameter_at(book, ParameterBook::Copy::kNext, i, after);
    if (std::string_view(before.value) == after.value) continue;
    PlacedMessage text("[");
    text << before.section << "] " << before.key << ": " << std::string_view(before.value) << " -> "
         << std::string_view(after.value);
    text << ", by " << std::string_view(by_);
    clients_.announce("parameter", Status::kOk, text.c_str(), now_ns);
  }
}

void ParameterRequests::take_verdict(double time_s, std::int64_t now_ns) {
  TuningVerdict verdict;
  if (!tuning_ || !mailboxes_.tuned.take(verdict)) return;
  tuning_ = false;
  const bool good = verdict.status == Status::kOk;
  Message text;
  if (good) {
    ++sets_;
    send_changes(now_ns);
    book_->commit();
  } else {
    book_->drop();
    text = refusal(pipeline_, verdict);
  }
  clients_.report(
      {from_, good ? Outcome::kExecuted : Outcome::kRefused, {verdict.status}, time_s, 0.0}, text,
      now_ns);
}

}  // namespace tactus
