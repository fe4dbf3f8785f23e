// Fuzzes the dashboard's greeting and replies as the HAL reads them, one line each.
#include "hal/ur/dashboard_client.hpp"
#include "tests/fuzz/ur/wire.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

using Answer = DashboardClient::Answer;

constexpr std::size_t kLongestLine = 255;

/// Whether the next line begins with `words`.
bool begins(std::string_view& text, std::string_view words) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos || end > kLongestLine) return false;
  std::size_t matched = 0;
  for (const char c : text.substr(0, end)) {
    if (matched == words.size()) break;
    if (c != words[matched++]) return false;
  }
  text.remove_prefix(end + 1);
  return matched == words.size();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::Tape tape(data, size);
  fuzz::wire.play(tape);
  DashboardClient client;
  Message why;
  std::string_view text = tape.text();
  const Status status = client.connect("127.0.0.1", 29999, Deadline(100), why);
  MUST((status == Status::kOk) == begins(text, "Connected:"));
  Answer answer = status == Status::kOk ? Answer::kYes : Answer::kLost;
  while (answer == Answer::kYes) {
    client.ask("power on", "Powering on");
    answer = client.poll(why);
    while (answer == Answer::kPending && !(tape.hangs && fuzz::wire.at == tape.size))
      answer = client.poll(why);
    MUST((answer == Answer::kYes) == begins(text, "Powering on"));
  }
  MUST(answer == Answer::kPending || !std::string_view(why).empty());
  return 0;
}
