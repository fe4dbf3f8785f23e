#include "gateway/mcap_writer.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "hal/serial/crc32.hpp"

namespace tactus {
namespace {

// A chunk ends with the first message that exceeds one of these: that much is lost if the program
// is killed.
constexpr std::size_t kChunk_bytes = 1 << 20;
constexpr std::uint64_t kChunk_ns = 1'000'000'000;

constexpr std::string_view kMagic = "\x89MCAP0\r\n";
constexpr std::string_view kEncoding = "protobuf", kNoCompression = "";

enum class Op : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

/// The content of a record. Numbers are little-endian, as on every host.
struct Content {
  std::string bytes;

  template <class Integer>
  Content& number(Integer value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
    return *this;
  }
  /// Appends bytes behind their size: a string, an array or a map.
  Content& sized(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size())).bytes += text;
    return *this;
  }
};

std::string record(Op op, std::string_view content) {
  Content record;
  record.number(op).number(std::uint64_t{content.size()}).bytes += content;
  return record.bytes;
}

std::uint32_t crc(std::string_view bytes) {
  return serial::crc32<std::numeric_limits<int>::max()>(
      reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

/// The summary under construction, and the offsets of its groups of records.
struct Summary {
  std::uint64_t begin;
  std::string bytes = {}, offsets = {};

  void add(Op op, std::string_view records) {
    if (records.empty()) return;
    Content offset;
    offset.number(op).number(begin + bytes.size()).number(std::uint64_t{records.size()});
    offsets += record(Op::kSummaryOffset, offset.bytes);
    bytes += records;
  }
};

}  // namespace

bool is_mcap(std::string_view path) {
  constexpr std::string_view kEnding = ".mcap";
  return path.size() > kEnding.size() && path.substr(path.size() - kEnding.size()) == kEnding;
}

void McapWriter::Times::add(std::uint64_t time_ns) {
  begin_ns = std::min(begin_ns, time_ns);
  end_ns = std::max(end_ns, time_ns);
}

void McapWriter::put(std::string_view bytes) {
  std::fwrite(bytes.data(), 1, bytes.size(), file_);
  size_ += bytes.size();
}

void McapWriter::begin(std::FILE* file, std::string_view library) {
  file_ = file;
  put(kMagic);
  put(record(Op::kHeader, Content().sized("").sized(library).bytes));
}

McapWriter::Id McapWriter::add_schema(std::string_view name, std::string_view descriptors) {
  const auto id = static_cast<Id>(schemas_.size() + 1);
  Content content;
  content.number(id).sized(name).sized(kEncoding).sized(descriptors);
  put(schemas_.emplace_back(record(Op::kSchema, content.bytes)));
  return id;
}

McapWriter::Id McapWriter::add_channel(Id schema, std::string_view topic, std::string_view quantity,
                                       std::string_view unit) {
  const auto id = static_cast<Id>(channels_.size() + 1);
  Content metadata, content;
  if (!quantity.empty()) metadata.sized("quantity").sized(quantity).sized("unit").sized(unit);
  content.number(id).number(schema).sized(topic).sized(kEncoding).sized(metadata.bytes);
  put(channels_.emplace_back(Channel{record(Op::kChannel, content.bytes), 0, {}}).record);
  return id;
}

void McapWriter::write(Id channel, std::int64_t time_ns, std::string_view message) {
  Channel& to = channels_[channel - std::size_t{1}];
  const auto time = static_cast<std::uint64_t>(time_ns);
  if (chunk_.empty()) chunk_times_ = {time, time};
  if (messages_++ == 0) times_ = {time, time};
  chunk_times_.add(time);
  times_.add(time);
  Content index, content;
  to.index += index.number(time).number(std::uint64_t{chunk_.size()}).bytes;
  content.number(channel).number(to.messages++).number(time).number(time).bytes += message;
  chunk_ += record(Op::kMessage, content.bytes);
  if (chunk_.size() >= kChunk_bytes || chunk_times_.end_ns - chunk_times_.begin_ns >= kChunk_ns)
    close_chunk();
}

void McapWriter::close_chunk() {
  if (chunk_.empty()) return;
  const std::uint64_t size = chunk_.size(), begin = size_;
  Content chunk;
  chunk.number(chunk_times_.begin_ns).number(chunk_times_.end_ns).number(size);
  chunk.number(crc(chunk_)).sized(kNoCompression).number(size).bytes += chunk_;
  put(record(Op::kChunk, chunk.bytes));
  chunk_.clear();

  const std::uint64_t indexes = size_;
  Content offsets, index;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i].index.empty()) continue;
    const auto id = static_cast<Id>(i + 1);
    offsets.number(id).number(size_);
    put(record(Op::kMessageIndex, Content().number(id).sized(channels_[i].index).bytes));
    channels_[i].index.clear();
  }
  index.number(chunk_times_.begin_ns).number(chunk_times_.end_ns);
  index.number(begin).number(indexes - begin).sized(offsets.bytes).number(size_ - indexes);
  index.sized(kNoCompression).number(size).number(size);
  chunk_indexes_ += record(Op::kChunkIndex, index.bytes);
  ++chunks_;
  std::fflush(file_);
}

std::string McapWriter::statistics() const {
  constexpr std::uint32_t kAttachments = 0, kMetadata = 0;
  Content counts, content;
  for (std::size_t i = 0; i < channels_.size(); ++i)
    counts.number(static_cast<Id>(i + 1)).number(std::uint64_t{channels_[i].messages});
  content.number(messages_).number(static_cast<std::uint16_t>(schemas_.size()));
  content.number(static_cast<std::uint32_t>(channels_.size()));
  content.number(kAttachments).number(kMetadata).number(chunks_);
  content.number(times_.begin_ns).number(times_.end_ns).sized(counts.bytes);
  return record(Op::kStatistics, content.bytes);
}

void McapWriter::end() {
  constexpr std::uint32_t kNoCrc = 0;
  constexpr std::uint64_t kFooterContent = 20;
  close_chunk();
  put(record(Op::kDataEnd, Content().number(kNoCrc).bytes));
  Summary summary{size_};
  std::string schemas, channels;
  for (const std::string& schema : schemas_) schemas += schema;
  for (const Channel& channel : channels_) channels += channel.record;
  summary.add(Op::kSchema, schemas);
  summary.add(Op::kChannel, channels);
  summary.add(Op::kStatistics, statistics());
  summary.add(Op::kChunkIndex, chunk_indexes_);
  Content judged;  // what the CRC of the footer is of: the summary, and the footer before the CRC
  judged.bytes = summary.bytes + summary.offsets;
  judged.number(Op::kFooter).number(kFooterContent);
  judged.number(summary.begin).number(summary.begin + summary.bytes.size());
  put(judged.number(crc(judged.bytes)).bytes);
  put(kMagic);
  std::fflush(file_);
}

}  // namespace tactus
