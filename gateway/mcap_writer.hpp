// McapWriter: writes messages with protobuf schemas into a recording in the MCAP format
// (https://mcap.dev/spec), which Foxglove, PlotJuggler and others open. Messages are collected in
// chunks with an index, without compression; a summary for random access ends the file. What is
// written is never changed again: the file may be a pipe, and one that was cut off can be read up
// to its last whole chunk.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace tactus {

/// True if the name of a file ends with ".mcap".
bool is_mcap(std::string_view path);

class McapWriter {
 public:
  /// Of a schema or a channel, from 1.
  using Id = std::uint16_t;

  /// Begins a recording in `file`, which belongs to the caller, as do its errors. `library` is the
  /// program that writes.
  void begin(std::FILE* file, std::string_view library);
  /// Adds the schema of the message `name`; `descriptors` is a serialised FileDescriptorSet.
  Id add_schema(std::string_view name, std::string_view descriptors);
  /// Adds a channel; its metadata are the quantity and unit of the messages, if they have one.
  Id add_channel(Id schema, std::string_view topic, std::string_view quantity = {},
                 std::string_view unit = {});
  /// Adds a serialised message at a time of at least 0. Chunks are closed in time, and flushed.
  void write(Id channel, std::int64_t time_ns, std::string_view message);
  /// Writes the last chunk and the summary.
  void end();

 private:
  struct Times {
    std::uint64_t begin_ns, end_ns;
    void add(std::uint64_t time_ns);
  };
  struct Channel {
    std::string record;
    std::uint32_t messages;
    std::string index;  // of its messages in the present chunk
  };

  void put(std::string_view bytes);
  void close_chunk();
  std::string statistics() const;

  std::FILE* file_ = nullptr;
  std::uint64_t size_ = 0;  // of what was written
  std::vector<std::string> schemas_;
  std::vector<Channel> channels_;
  std::string chunk_;          // records of the present chunk
  std::string chunk_indexes_;  // records of the summary
  std::uint32_t chunks_ = 0;
  std::uint64_t messages_ = 0;
  Times chunk_times_{}, times_{};
};

}  // namespace tactus
