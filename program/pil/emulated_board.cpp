#include "program/pil/emulated_board.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>

extern char** environ;

namespace tactus::pil {
namespace {

constexpr int kLook_ms = 100, kLooks = 100;  // in all the longest silence
using Path = Text<64>;

struct CoreMachine {
  std::string_view core;
  const char* machine;
};
constexpr CoreMachine kMachines[] = {{"m7", "mps2-an500"}, {"m55", "mps3-an547"}};

Path in_folder(const char* folder, const char* name) {
  Path path(folder);
  return path << "/" << name;
}

}  // namespace

BoardImage image_of(std::string_view builds, std::string_view board, std::string_view rest) {
  const std::string_view core = board.substr(board.rfind('_') + 1);
  BoardImage image = {Text<1023>(builds), nullptr};
  image.path << "/" << board << "-" << core << rest;
  for (const CoreMachine& each : kMachines)
    if (each.core == core) image.machine = each.machine;
  return image;
}

bool EmulatedBoard::make_pipes(Message& why) {
  std::strcpy(folder_.data(), "/tmp/tactus-board-XXXXXX");
  const bool made = mkdtemp(folder_.data()) != nullptr;
  const Path to = in_folder(folder_.data(), "to_board"),
             from = in_folder(folder_.data(), "from_board");
  if (made && mkfifo(to.c_str(), 0600) == 0 && mkfifo(from.c_str(), 0600) == 0) {
    out_ = open(to.c_str(), O_RDWR | O_CLOEXEC);  // to be able to open it before the board does
    in_ = open(from.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  }
  if (in_ >= 0 && out_ >= 0) return true;
  why = Message("no pipes for the board: ");
  why << std::strerror(errno);
  return false;
}

/// The clock of the board counts its instructions, 1 ns each, so that two runs are the same.
bool EmulatedBoard::spawn(const BoardImage& image, Message& why) {
  Text<128> semihosting("enable=on,target=native,arg=board,arg=");
  semihosting << folder_.data();
  const char* const arguments[] = {"qemu-system-arm",
                                   "-M",
                                   image.machine,
                                   "-nographic",
                                   "-monitor",
                                   "none",
                                   "-serial",
                                   "none",
                                   "-icount",
                                   "shift=0,sleep=off",
                                   "-semihosting-config",
                                   semihosting.c_str(),
                                   "-kernel",
                                   image.path.c_str(),
                                   nullptr};
  posix_spawnattr_t attributes;  // a group of its own: Ctrl-C is for this program, which ends it
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int error = posix_spawnp(&process_, arguments[0], nullptr, &attributes,
                                 const_cast<char* const*>(arguments), environ);
  posix_spawnattr_destroy(&attributes);
  if (error == 0) return true;
  process_ = 0;
  why = Message("qemu-system-arm: ");
  why << std::strerror(error) << "; as root: scripts/setup wcet";
  return false;
}

bool EmulatedBoard::start(const BoardImage& image, Message& why) {
  stop();
  if (image.machine == nullptr) {
    why = Message(image.path);
    why << ": the emulator has no machine with the core of this board; boards:";
    for (const CoreMachine& each : kMachines) why << " <robot>_" << each.core;
    return false;
  }
  if (access(image.path.c_str(), R_OK) != 0) {
    why = Message(image.path);
    why << ": " << std::strerror(errno) << "; make builds it with the program of this board";
    return false;
  }
  return make_pipes(why) && spawn(image, why);
}

/// Without the other end of its pipes the board ends the emulator; one that hangs is ended.
void EmulatedBoard::end_process() {
  constexpr timespec kLook = {0, 10'000'000};
  for (int i = 0; i < 100 && process_ > 0; ++i) {
    if (waitpid(process_, nullptr, WNOHANG) != 0) process_ = 0;
    if (process_ > 0) nanosleep(&kLook, nullptr);
  }
  if (process_ <= 0) return;
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
  process_ = 0;
}

void EmulatedBoard::stop() {
  if (in_ >= 0) close(in_);
  if (out_ >= 0) close(out_);
  in_ = out_ = -1;
  end_process();
  if (folder_[0] == '\0') return;
  unlink(in_folder(folder_.data(), "to_board").c_str());
  unlink(in_folder(folder_.data(), "from_board").c_str());
  rmdir(folder_.data());
  folder_[0] = '\0';
}

/// True if the emulator has ended by itself.
bool EmulatedBoard::has_ended() {
  if (process_ > 0 && waitpid(process_, nullptr, WNOHANG) == process_) process_ = 0;
  return process_ == 0;
}

/// A signal ends no wait: the arm is to be braked first.
bool EmulatedBoard::read_all(std::uint8_t* to, std::size_t size) {
  int looks = 0;
  for (std::size_t got = 0; got < size;) {
    pollfd ready = {in_, POLLIN, 0};
    const int found = poll(&ready, 1, kLook_ms);
    if (found == 0 && (has_ended() || ++looks == kLooks)) return false;
    if (found <= 0) continue;
    const ssize_t part = read(in_, to + got, size - got);
    if (part == 0 || (part < 0 && errno != EINTR && errno != EAGAIN)) return false;
    if (part > 0) got += static_cast<std::size_t>(part);
  }
  return true;
}

int EmulatedBoard::receive(std::uint8_t* to) {
  std::uint8_t head[2];
  if (!running() || !read_all(head, sizeof head)) return -1;
  const std::size_t size = static_cast<std::size_t>(head[0] << 8 | head[1]);
  return size <= kMost && read_all(to, size) ? static_cast<int>(size) : -1;
}

bool EmulatedBoard::send(const std::uint8_t* bytes, std::size_t size) {
  if (!running() || size > kMost) return false;
  std::array<std::uint8_t, 2 + kMost> part;
  part[0] = static_cast<std::uint8_t>(size >> 8);
  part[1] = static_cast<std::uint8_t>(size);
  std::copy(bytes, bytes + size, part.begin() + 2);
  ssize_t written = 0;
  do {
    written = write(out_, part.data(), 2 + size);  // whole: a pipe holds more
  } while (written < 0 && errno == EINTR);
  return written == static_cast<ssize_t>(2 + size);
}

}  // namespace tactus::pil
