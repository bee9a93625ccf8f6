#include "net/web_files.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <utility>

#include <zlib.h>

#include "core/error.h"
#include "core/file.h"

namespace myotact::net {

namespace {

std::string gzip(const std::string& bytes) {
  constexpr int kGzip = 15 + 16;  // the largest window, with a header of gzip
  constexpr int kMemory = 8;      // zlib's default
  z_stream stream{};
  if (bytes.size() > std::numeric_limits<uInt>::max() ||
      deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kGzip, kMemory, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw Error(ExitStatus::Internal, "a file for browsers cannot be compressed: no memory");
  }
  std::string compressed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // zlib reads it only
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(compressed.data());
  stream.avail_out = static_cast<uInt>(compressed.size());
  deflate(&stream, Z_FINISH);  // the room is enough: it cannot fail
  compressed.resize(stream.total_out);
  deflateEnd(&stream);
  return compressed;
}

}  // namespace

WebFile web_file(std::string content_type, std::string body) {
  constexpr std::size_t kTagDigits = 16;
  WebFile file;
  file.gzip = gzip(body);
  file.tag = '"' + sha256(body).substr(0, kTagDigits) + '"';
  file.content_type = std::move(content_type);
  file.body = std::move(body);
  return file;
}

std::string security_policy(const std::string& host) {
  const bool is_plain = std::all_of(host.begin(), host.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '.' || c == ':' || c == '-' || c == '[' || c == ']';
  });
  // Browsers before 2022 do not count a WebSocket of the page's own host as 'self'.
  const std::string sockets = is_plain && !host.empty() ? " ws://" + host : "";
  return "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'" +
         sockets + "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
}

}  // namespace myotact::net
