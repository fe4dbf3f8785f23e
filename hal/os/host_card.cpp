// The items of a host that belong to the network card of the robot: how soon a packet wakes the
// cycle that waits for it.
#include <linux/ethtool.h>
#include <linux/sockios.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "hal/os/host_items.hpp"

namespace tactus::host {
namespace {

constexpr int kThreadedInterrupt = 50;  // the priority that the kernel gives to all of them

/// The interrupts of the card.
struct Interrupts {
  std::array<int, 128> numbers{};
  std::size_t count = 0;

  void add(int number) {
    if (number >= 0 && count < numbers.size()) numbers[count++] = number;
  }
  bool has(int number) const {
    return std::find(numbers.begin(), numbers.begin() + count, number) != numbers.begin() + count;
  }
  Text<95> text() const {
    Text<95> list;
    for (std::size_t i = 0; i < std::min(count, std::size_t{8}); ++i) list << " " << numbers[i];
    if (count > 8) list << " ...";
    return list;
  }
};

bool named(const HostQuery& query) {
  return query.interface[0] != '\0';
}

Content no_interface() {
  return {HostFinding::kUnknown, Text<127>("no interface is named")};
}

/// Finds the interrupts: several by messages, of the device or of the bus device that a virtual one
/// is on; or one by a line.
Interrupts find_interrupts(const HostQuery& query) {
  Interrupts found;
  const Path device = Path("/sys/class/net/") << query.interface << "/device";
  const auto add = [&found](int number) { found.add(number); };
  for (const char* folder : {"/msi_irqs", "/../msi_irqs"})
    if (found.count == 0) for_each_number(query, Path(device) << folder, add);
  SmallFile line;
  if (found.count == 0 && read(query, Path(device) << "/irq", line)) add(leading_int(line.text()));
  return found;
}

/// Returns the real-time priority of a thread; -1 if it cannot be read.
int realtime_priority(const HostQuery& query, int thread) {
  constexpr int kFieldsBefore = 37;  // of proc(5) stat, between the name and rt_priority
  SmallFile stat;
  if (!read(query, Path("/proc/") << thread << "/stat", stat)) return -1;
  std::string_view rest = stat.text();
  const std::size_t name_end = rest.rfind(") ");
  if (name_end == rest.npos) return -1;
  rest.remove_prefix(name_end + 2);
  for (int i = 0; i < kFieldsBefore && !rest.empty(); ++i)
    rest.remove_prefix(std::min(rest.size(), first_word(rest).size() + 1));
  return leading_int(rest);
}

}  // namespace

Content card_affinity(const HostQuery& query) {
  if (!named(query)) return no_interface();
  if (query.cpu < 0) return {HostFinding::kUnknown, Text<127>(kNoCpu)};
  const Interrupts card = find_interrupts(query);
  Interrupts here;
  int readable = 0;
  for (std::size_t i = 0; i < card.count; ++i) {
    SmallFile file;
    if (!read_affinity(query, card.numbers[i], file)) continue;
    ++readable;
    if (lists_cpu(file.text(), query.cpu)) here.add(card.numbers[i]);
  }
  if (readable == 0) return unreadable(0);
  Text<127> value;
  value << static_cast<int>(here.count) << " of " << readable << " on cpu" << query.cpu;
  if (here.count > 0) value << ":" << here.text();
  return judge(here.count == 0, value);
}

/// Judges the lowest priority of the threads named "irq/<interrupt>-<action>".
Content card_priority(const HostQuery& query) {
  if (!named(query)) return no_interface();
  const Interrupts card = find_interrupts(query);
  if (card.count == 0) return unreadable(0);
  int lowest = -1, interrupt = -1;
  bool readable = true;
  const bool listed = for_each_number(query, "/proc", [&](int thread) {
    SmallFile name;
    if (!read(query, Path("/proc/") << thread << "/comm", name)) return;
    if (name.text().substr(0, 4) != "irq/") return;
    const int number = leading_int(name.text().substr(4));
    if (!card.has(number)) return;
    const int found = realtime_priority(query, thread);
    readable = readable && found >= 0;
    if (lowest >= 0 && found >= lowest) return;
    lowest = found;
    interrupt = number;
  });
  if (!listed || !readable) return unreadable(0);
  if (lowest < 0)
    return {HostFinding::kHurts, Text<127>("no thread for interrupts") << card.text()};
  return judge(lowest > kThreadedInterrupt, Text<127>("priority ")
                                                << lowest << " for interrupt " << interrupt);
}

/// An interrupt is delayed by a time, or until as many packets have arrived, unless they are one.
Content card_coalescing(const HostQuery& query) {
  if (!named(query)) return no_interface();
  if (query.ethtool == nullptr)
    return {HostFinding::kUnknown, Text<127>("not readable: below a root of files")};
  ethtool_coalesce coalesce{};
  coalesce.cmd = ETHTOOL_GCOALESCE;
  ifreq request{};
  const std::string_view name(query.interface);
  name.copy(request.ifr_name, sizeof request.ifr_name - 1);
  request.ifr_data = reinterpret_cast<char*>(&coalesce);
  const int file = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (file < 0) return unreadable(errno);
  const int error = query.ethtool(file, SIOCETHTOOL, &request) == 0 ? 0 : errno;
  close(file);
  if (error != 0) return unreadable(error);
  const bool adaptive = coalesce.use_adaptive_rx_coalesce != 0;
  const bool by_time = coalesce.rx_coalesce_usecs > 0 && coalesce.rx_max_coalesced_frames != 1;
  const bool by_count = coalesce.rx_coalesce_usecs == 0 && coalesce.rx_max_coalesced_frames > 1;
  return judge(!adaptive && !by_time && !by_count,
               Text<127>("adaptive-rx ")
                   << (adaptive ? "on" : "off") << ", rx-usecs "
                   << std::size_t{coalesce.rx_coalesce_usecs} << ", rx-frames "
                   << std::size_t{coalesce.rx_max_coalesced_frames});
}

Content busy_poll(const HostQuery& query) {
  if (!named(query)) return no_interface();
  SmallFile file;
  if (!read(query, "/proc/sys/net/core/busy_poll", file)) return unreadable(file);
  return judge(leading_int(file.text()) > 0, Text<127>("busy_poll ") << file.text());
}

}  // namespace tactus::host
