// Fuzzes mailbox messages at both ends: the master's CoE client and the drive's server.
#include "hal/ethercat/coe_client.hpp"
#include "sim_plant/ethercat/coe_server.hpp"
#include "tests/fuzz/fuzzing.hpp"

namespace {

using namespace tactus;
using namespace tactus::ethercat;

constexpr std::size_t kBox = 64;

void check_client(const CoeClient& client) {
  MUST(client.progress() == CoeClient::Progress::kAborted || client.size() <= CoeClient::kCapacity);
  MUST(!client.describe().empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static drives::Dictionary dictionary;
  static segment::CoeObjects objects(dictionary);
  static segment::CoeServer server(objects);
  dictionary.reset(1);
  objects.reset();
  server.reset(kBox);
  CoeClient client;
  std::uint8_t counter = 0;
  std::int64_t now_ns = 0;
  // Each record: what to do, the length of a message, its bytes.
  for (std::size_t at = 0; at + 2 <= size;) {
    const std::uint8_t kind = data[at];
    const std::size_t length = data[at + 1] % (kBox + 1);
    at += 2;
    std::array<std::uint8_t, kBox> message{};
    for (std::size_t i = 0; i < length && at < size; ++i) message[i] = data[at++];
    now_ns += kind * 1'000'000;
    client.advance(now_ns);
    if (client.progress() != CoeClient::Progress::kBusy) {
      if ((kind & 4) != 0)
        client.download_bytes(kBox, 0x6080, 0, message.data(), length, now_ns);
      else
        client.upload(kBox, 0x1008, 0, now_ns);
    }
    std::array<std::uint8_t, kBox> request{};
    if (client.take(request.data(), request.size(), counter))
      MUST(get<std::uint16_t>(request.data()) + kMailboxBytes <= kBox);
    can::Emergency emergency;
    if ((kind & 1) != 0)
      (void)client.receive(message.data(), message.size(), emergency, now_ns);
    else
      (void)server.receive((kind & 2) != 0 ? request.data() : message.data(), kBox, true, false);
    check_client(client);
    segment::MailboxMessage answer;
    while (server.take(answer)) {
      MUST(answer.size <= kBox);
      if ((kind & 8) != 0) (void)client.receive(answer.bytes.data(), kBox, emergency, now_ns);
    }
    for (const bool outputs : {true, false})
      MUST(objects.process_data(outputs).bytes <= segment::kMostPdoBytes);
  }
  return 0;
}
