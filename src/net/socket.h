#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

namespace myotact::net {

/// A file descriptor that is closed with its owner.
class Socket {
 public:
  Socket() = default;
  explicit Socket(int descriptor) noexcept : descriptor_(descriptor) {}
  Socket(Socket&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Socket& operator=(Socket&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~Socket();

  int descriptor() const noexcept { return descriptor_; }
  explicit operator bool() const noexcept { return descriptor_ >= 0; }

 private:
  int descriptor_ = -1;
};

/// HOST:PORT or [ADDRESS]:PORT, with a default port where none is given.
struct Endpoint {
  std::string host;
  std::uint16_t port = 0;
};
/// Throws Error Usage that states what is wrong with the text.
Endpoint parse_endpoint(const std::string& text, std::uint16_t default_port);

/// Whether a numeric address or name means this machine alone.
bool is_loopback(const std::string& address);

/// Listens for TCP connections; port 0 takes a free one. Throws Error Unavailable (in use, no such address).
Socket listen_at(const Endpoint& endpoint);
std::uint16_t port_of(const Socket& listener);

/// The next connection, TCP_NODELAY set, or none: nothing came within `wait`, or the listener was shut down.
Socket accept_from(const Socket& listener, std::chrono::milliseconds wait, std::string& peer_address);

/// TCP_NODELAY set. Throws Error Unavailable: refused, no such host, no answer within `wait`.
Socket connect_to(const Endpoint& endpoint, std::chrono::milliseconds wait);

/// Two ends of a stream within this process. Throws Error Unavailable.
std::pair<Socket, Socket> socket_pair();

/// How long receive() waits on this socket.
void set_patience(const Socket& socket, std::chrono::milliseconds wait) noexcept;

enum class Received { Some, Closed, TimedOut };
/// Waits for bytes; `count` of them came.
Received receive(const Socket& socket, std::span<std::uint8_t> room, std::size_t& count) noexcept;

enum class Sent { All, None, Failed };
/// Sends both parts as one, or none of them: None when the peer takes nothing now and `may_drop` is set. Failed: the
/// peer is gone, took nothing for `wait`, or is slower than the slowest line (16 kB/s). One caller at a time.
Sent send(const Socket& socket, std::span<const std::uint8_t> head, std::span<const std::uint8_t> body, bool may_drop,
          std::chrono::milliseconds wait) noexcept;

/// Wakes whoever waits on the socket; nothing comes or goes any more.
void shut_down(const Socket& socket) noexcept;

}  // namespace myotact::net
