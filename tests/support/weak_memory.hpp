// A machine with weak memory, on which small lock-free code runs in every way that the C++ memory
// model lets it: relaxed, acquire and release on atomics that one thread writes, and plain data.
//
// Of every atomic all writes are kept, each with what a thread learns that acquires it. A load
// takes any write that is not older than the newest its thread knows of; which one is a choice, and
// all choices are tried. Plain data are raced for when two threads' accesses are not ordered by
// what they have learned (vector clocks). That is the promise-free part of Kang, Hur, Lahav,
// Vafeiadis, Dreyer: A Promising Semantics for Relaxed-Memory Concurrency, POPL 2017.
//
// Threads need not be interleaved within a call that stores, for another to see, only at its end:
// what a load could have taken earlier it can still take later. Nor one thread at all with others
// whose stores it does not read: they come after it and look back.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "tests/support/testing.hpp"

namespace tactus::weak {

inline constexpr std::size_t kThreads = 2, kPlaces = 24;

/// What a thread knows: of every atomic the newest write, of every thread how far it had come.
struct View {
  std::array<std::size_t, kPlaces> newest{};
  std::array<int, kThreads> clock{};

  void learn(const View& other) {
    for (std::size_t i = 0; i < kPlaces; ++i) newest[i] = std::max(newest[i], other.newest[i]);
    for (std::size_t i = 0; i < kThreads; ++i) clock[i] = std::max(clock[i], other.clock[i]);
  }
};

/// Every combination of choices, one run after the other.
class Choices {
 public:
  /// 0 ... count - 1.
  std::size_t choose(std::size_t count) {
    if (at_ == path_.size()) path_.push_back({0, count});
    return path_[at_++].taken;
  }
  /// False when all were tried.
  bool next() {
    at_ = 0;
    while (!path_.empty() && path_.back().taken + 1 == path_.back().count) path_.pop_back();
    if (path_.empty()) return false;
    ++path_.back().taken;
    return true;
  }

 private:
  struct Choice {
    std::size_t taken, count;
  };
  std::vector<Choice> path_;
  std::size_t at_ = 0;
};

/// Accesses that are relaxed whatever the code says: of atomics by number, in the order in which
/// they are constructed.
struct Weakened {
  std::size_t first = 0, end = 0;
  bool stores = false;
};

class Memory {
 public:
  Memory(Choices& choices, const Weakened& weakened) : choices_(choices), weakened_(weakened) {}

  /// What was set up is known to all threads, which begin now.
  void begin() {
    for (std::size_t i = 0; i < places_.size(); ++i)
      for (View& view : views_) view.newest[i] = places_[i].size() - 1;
    for (std::size_t i = 0; i < kThreads; ++i) views_[i].clock[i] = 1;
    begun_ = true;
  }
  /// From now on `thread` runs.
  void run(std::size_t thread) { thread_ = thread; }
  std::size_t choose(std::size_t count) { return choices_.choose(count); }

  std::size_t add(std::uint64_t value) {
    assert_true(places_.size() < kPlaces);
    places_.push_back({{value, View()}});
    writers_.push_back(kThreads);
    return places_.size() - 1;
  }
  void store(std::size_t place, std::uint64_t value, std::memory_order order) {
    View& own = views_[thread_];
    if (begun_) {
      assert_true(writers_[place] == kThreads || writers_[place] == thread_);  // of the model
      writers_[place] = thread_;
    }
    own.newest[place] = places_[place].size();
    const bool releases = order != std::memory_order_relaxed && !weakens(place, true);
    View told;
    told.newest[place] = own.newest[place];
    places_[place].push_back({value, releases ? own : told});
    if (releases) ++own.clock[thread_];
  }
  std::uint64_t load(std::size_t place, std::memory_order order) {
    View& own = views_[thread_];
    const std::vector<Write>& writes = places_[place];
    const std::size_t oldest = own.newest[place];
    const Write& write = writes[oldest + choose(writes.size() - oldest)];
    own.newest[place] = static_cast<std::size_t>(&write - writes.data());
    if (order != std::memory_order_relaxed && !weakens(place, false)) own.learn(write.view);
    return write.value;
  }

  std::size_t thread() const { return thread_; }
  int clock() const { return begun_ ? views_[thread_].clock[thread_] : 0; }
  /// The running thread must know of what `thread` did at `clock`.
  void expect_ordered(std::size_t thread, int clock) {
    raced_ = raced_ || (thread != thread_ && views_[thread_].clock[thread] < clock);
  }
  bool raced() const { return raced_; }

 private:
  struct Write {
    std::uint64_t value;
    View view;
  };
  bool weakens(std::size_t place, bool store) const {
    return place >= weakened_.first && place < weakened_.end && store == weakened_.stores;
  }

  Choices& choices_;
  Weakened weakened_;
  std::vector<std::vector<Write>> places_;
  std::vector<std::size_t> writers_;
  std::array<View, kThreads> views_{};
  std::size_t thread_ = 0;
  bool begun_ = false, raced_ = false;
};

/// The machine on which the code of this run is constructed.
inline Memory* g_memory = nullptr;

/// In place of std::atomic.
template <class T>
class Atomic {
 public:
  Atomic(T value = {}) : place_(g_memory->add(static_cast<std::uint64_t>(value))) {}  // NOLINT
  void store(T value, std::memory_order order) {
    g_memory->store(place_, static_cast<std::uint64_t>(value), order);
  }
  T load(std::memory_order order) const { return static_cast<T>(g_memory->load(place_, order)); }

 private:
  std::size_t place_;
};

/// A number that is no atomic.
class Plain {
 public:
  Plain() = default;
  Plain(const Plain& other) { *this = other; }
  Plain& operator=(const Plain& other) {
    write(other.read());
    return *this;
  }
  void write(int value) {
    g_memory->expect_ordered(writer_, written_);
    for (std::size_t i = 0; i < kThreads; ++i) g_memory->expect_ordered(i, read_[i]);
    writer_ = g_memory->thread();
    written_ = g_memory->clock();
    value_ = value;
  }
  int read() const {
    g_memory->expect_ordered(writer_, written_);
    read_[g_memory->thread()] = g_memory->clock();
    return value_;
  }

 private:
  int value_ = 0;
  std::size_t writer_ = 0;
  int written_ = 0;                           // by the writer's clock
  mutable std::array<int, kThreads> read_{};  // by each thread's
};

/// What all runs came to.
struct Explored {
  std::int64_t runs = 0, wrong = 0;
};

/// Runs `run(memory)`, which says whether all was right, in every way there is, or until the first
/// that is wrong.
template <class Run>
Explored explore(const Weakened& weakened, Run run) {
  Choices choices;
  Explored result;
  do {
    Memory memory(choices, weakened);
    g_memory = &memory;
    const bool right = run(memory);
    ++result.runs;
    result.wrong += !right || memory.raced();
  } while (result.wrong == 0 && choices.next());
  g_memory = nullptr;
  return result;
}

}  // namespace tactus::weak
