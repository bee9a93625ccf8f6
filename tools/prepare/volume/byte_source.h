#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Bytes one after the other, so that a volume of any size is decoded without a copy of its file in memory.

namespace myotact::prepare {

class ByteSource {
 public:
  virtual ~ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  /// Fills `out` with the next bytes and returns how many there were: fewer than `wanted` only at the end.
  std::size_t read(char* out, std::size_t wanted);
  /// The next line without its end (LF or CR LF), nothing at the end; of a longer one only the first `longest` bytes.
  std::optional<std::string> line(std::size_t longest);
  /// Passes over bytes and returns how many there were.
  std::uint64_t skip(std::uint64_t wanted);
  /// The next bytes, which stay; fewer only at the end. At most 8.
  std::string_view peek(std::size_t wanted);
  /// No more bytes than these can come: exact for a file, a bound for compressed bytes.
  std::uint64_t most_left() const;

 protected:
  ByteSource();
  /// Up to `room` further bytes, 0 at the end. Throws Error.
  virtual std::size_t refill(char* out, std::size_t room) = 0;
  virtual std::uint64_t most_left_to_refill() const = 0;

 private:
  bool fill();

  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;
};

/// A regular file. Throws Error: NoInput when it cannot be opened, BadData when it is a folder or a device, InputOutput
/// when reading fails.
std::unique_ptr<ByteSource> open_bytes(const std::filesystem::path& path);

/// `bytes` must outlive it.
std::unique_ptr<ByteSource> bytes_in_memory(std::string_view bytes);

/// What gzip (also of several members) or zlib packed. Reading throws Error BadData that names `file` and says whether
/// the stream is cut off, damaged, or followed by other bytes. `packed` must outlive it.
std::unique_ptr<ByteSource> unpacked(ByteSource& packed, const std::string& file);

}  // namespace myotact::prepare
