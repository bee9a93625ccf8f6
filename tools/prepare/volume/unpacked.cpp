#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

#include "core/error.h"
#include "prepare/volume/byte_source.h"

namespace myotact::prepare {

namespace {

/// Deflate cannot pack 1032 bytes into less than one (zlib's technical details): a file that claims more than that is
/// refused before any memory is taken for it.
constexpr std::uint64_t kMostPacking = 1032;
constexpr int kGzipOrZlib = 32 + MAX_WBITS;  // inflateInit2: tells the two apart by their first bytes

class UnpackedSource final : public ByteSource {
 public:
  UnpackedSource(ByteSource& packed, std::string file) : packed_(packed), file_(std::move(file)), input_(1 << 16) {
    if (inflateInit2(&stream_, kGzipOrZlib) != Z_OK) throw Error(ExitStatus::Internal, "zlib cannot start: no memory");
  }
  ~UnpackedSource() override { inflateEnd(&stream_); }

 protected:
  std::size_t refill(char* out, std::size_t room) override {
    stream_.next_out = reinterpret_cast<Bytef*>(out);
    stream_.avail_out = static_cast<uInt>(room);
    while (stream_.avail_out == room && !ended_) {
      if (stream_.avail_in == 0) take_input();
      step();
    }
    return room - stream_.avail_out;
  }

  std::uint64_t most_left_to_refill() const override {
    // What zlib holds back is at most its window.
    constexpr std::uint64_t kWindow = 1 << MAX_WBITS;
    return ended_ ? 0 : (packed_.most_left() + stream_.avail_in) * kMostPacking + kWindow;
  }

 private:
  void take_input() {
    const std::size_t got = packed_.read(input_.data(), input_.size());
    if (got == 0) {
      throw bad_data(file_, "", "ends within its compressed data: it is cut off. Copy or save it again");
    }
    stream_.next_in = reinterpret_cast<Bytef*>(input_.data());
    stream_.avail_in = static_cast<uInt>(got);
  }

  void step() {
    const int result = inflate(&stream_, Z_NO_FLUSH);
    if (result == Z_STREAM_END) {
      end_of_member();
    } else if (result != Z_OK && result != Z_BUF_ERROR) {
      throw bad_data(file_, fmt::format("compressed data, byte {}", stream_.total_in),
                     fmt::format("is damaged or no gzip: {}. Copy or save it again",
                                 stream_.msg ? stream_.msg : "unexpected bytes"));
    }
  }

  /// gzip allows several members one after the other, as parallel packers write them.
  void end_of_member() {
    if (stream_.avail_in == 0 && packed_.most_left() > 0) take_input();
    if (stream_.avail_in == 0) {
      ended_ = true;
      return;
    }
    constexpr Bytef kGzip = 0x1f;
    if (*stream_.next_in != kGzip) {
      throw bad_data(
          file_, "",
          fmt::format("has further bytes after its compressed data, {} or more; save it again", stream_.avail_in));
    }
    inflateReset(&stream_);
  }

  ByteSource& packed_;
  std::string file_;
  std::vector<char> input_;
  z_stream stream_{};
  bool ended_ = false;
};

}  // namespace

std::unique_ptr<ByteSource> unpacked(ByteSource& packed, const std::string& file) {
  return std::make_unique<UnpackedSource>(packed, file);
}

}  // namespace myotact::prepare
