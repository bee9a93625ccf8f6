#include "net/socket.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <memory>
#include <thread>

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include "core/error.h"

namespace myotact::net {

namespace {

constexpr std::chrono::milliseconds kNoRoom(50);  // until another connection may have left
constexpr double kSlowest_bytes_s = 16e3;         // of a peer that is not stuck

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

Addresses resolve(const Endpoint& endpoint, int flags) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = flags | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const std::string port = std::to_string(endpoint.port);
  const int failure = getaddrinfo(endpoint.host.c_str(), port.c_str(), &hints, &found);
  if (failure != 0) {
    throw Error(ExitStatus::Unavailable,
                fmt::format("{}: no such address: {}; give a name or a number of a machine that this one can reach",
                            endpoint.host, gai_strerror(failure)));
  }
  return {found, &freeaddrinfo};
}

void set_option(const Socket& socket, int level, int option, int value) noexcept {
  setsockopt(socket.descriptor(), level, option, &value, sizeof value);  // without it things are slower, not wrong
}

/// True: ready; false: nothing within the time, or the descriptor is of no use.
bool wait_for(const Socket& socket, short event, std::chrono::milliseconds wait) noexcept {
  pollfd watched{socket.descriptor(), event, 0};
  const auto until = std::chrono::steady_clock::now() + wait;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
    const int ready = poll(&watched, 1, static_cast<int>(std::max<std::int64_t>(0, left.count())));
    if (ready >= 0 || errno != EINTR) return ready > 0;
  }
}

Error unreachable(const Endpoint& endpoint, const std::string& why) {
  return {ExitStatus::Unavailable, fmt::format("{}:{}: {}; is `myotact serve` running there, and is this its port?",
                                               endpoint.host, endpoint.port, why)};
}

Socket connect_to(const addrinfo& address, std::chrono::milliseconds wait, std::string& why) {
  Socket socket(::socket(address.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket) {
    why = std::strerror(errno);
    return {};
  }
  if (connect(socket.descriptor(), address.ai_addr, address.ai_addrlen) != 0) {
    int failure = errno;
    if (failure == EINPROGRESS) {
      socklen_t size = sizeof failure;
      if (!wait_for(socket, POLLOUT, wait)) {
        failure = ETIMEDOUT;
      } else {
        getsockopt(socket.descriptor(), SOL_SOCKET, SO_ERROR, &failure, &size);
      }
    }
    if (failure != 0) {
      why = std::strerror(failure);
      return {};
    }
  }
  fcntl(socket.descriptor(), F_SETFL, 0);  // from here on it waits
  set_option(socket, IPPROTO_TCP, TCP_NODELAY, 1);
  return socket;
}

}  // namespace

Socket::~Socket() {
  if (descriptor_ >= 0) close(descriptor_);
}

Endpoint parse_endpoint(const std::string& text, std::uint16_t default_port) {
  Endpoint endpoint{text, default_port};
  const std::size_t bracket = text.starts_with('[') ? text.find(']') : std::string::npos;
  const bool is_bare_v6 = bracket == std::string::npos && text.find(':') != text.rfind(':');
  const std::size_t colon = is_bare_v6 ? std::string::npos : text.find(':', bracket == std::string::npos ? 0 : bracket);
  if (colon != std::string::npos) {
    endpoint.host = text.substr(0, colon);
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data() + colon + 1, end, endpoint.port);
    if (read.ec != std::errc() || read.ptr != end) {
      throw Error(ExitStatus::Usage, fmt::format("\"{}\": the port is to be a number from 0 to 65535", text));
    }
  }
  if (bracket != std::string::npos) endpoint.host = text.substr(1, bracket - 1);
  if (endpoint.host.empty()) throw Error(ExitStatus::Usage, fmt::format("\"{}\": name a machine: HOST:PORT", text));
  return endpoint;
}

bool is_loopback(const std::string& address) {
  const Addresses found = resolve({address, 0}, 0);
  for (const addrinfo* next = found.get(); next != nullptr; next = next->ai_next) {
    if (next->ai_family == AF_INET) {
      const auto& v4 = *reinterpret_cast<const sockaddr_in*>(next->ai_addr);
      if ((ntohl(v4.sin_addr.s_addr) >> 24) != 127) return false;
    } else if (next->ai_family == AF_INET6) {
      if (!IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<const sockaddr_in6*>(next->ai_addr)->sin6_addr)) return false;
    }
  }
  return true;
}

Socket listen_at(const Endpoint& endpoint) {
  const Addresses found = resolve(endpoint, AI_PASSIVE);
  Socket socket(::socket(found->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (socket) set_option(socket, SOL_SOCKET, SO_REUSEADDR, 1);  // a server that restarts finds its port again
  constexpr int kWaiting = 4096;                                // a beginner beyond it waits a second for its next try
  if (!socket || bind(socket.descriptor(), found->ai_addr, found->ai_addrlen) != 0 ||
      listen(socket.descriptor(), kWaiting) != 0) {
    throw Error(ExitStatus::Unavailable, fmt::format("{}:{}: cannot listen there: {}; choose another --port or --bind",
                                                     endpoint.host, endpoint.port, std::strerror(errno)));
  }
  return socket;
}

std::uint16_t port_of(const Socket& listener) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  getsockname(listener.descriptor(), reinterpret_cast<sockaddr*>(&address), &size);
  return address.ss_family == AF_INET6 ? ntohs(reinterpret_cast<const sockaddr_in6&>(address).sin6_port)
                                       : ntohs(reinterpret_cast<const sockaddr_in&>(address).sin_port);
}

Socket accept_from(const Socket& listener, std::chrono::milliseconds wait, std::string& peer_address) {
  if (!wait_for(listener, POLLIN, wait)) return {};
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  auto* peer = reinterpret_cast<sockaddr*>(&address);
  Socket socket(accept4(listener.descriptor(), peer, &size, SOCK_CLOEXEC));
  if (!socket) {
    // No descriptor is free, so the one who knocks stays there: without a pause this would be asked again and again.
    if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM) std::this_thread::sleep_for(kNoRoom);
    return {};
  }
  std::array<char, NI_MAXHOST> host{};
  getnameinfo(peer, size, host.data(), host.size(), nullptr, 0, NI_NUMERICHOST);
  peer_address = host.data();
  set_option(socket, IPPROTO_TCP, TCP_NODELAY, 1);
  // What waits here to be sent grows old: a slow line gets newer models the less of it there is.
  constexpr int kUnsent_bytes = 1 << 14;
  set_option(socket, IPPROTO_TCP, TCP_NOTSENT_LOWAT, kUnsent_bytes);
  return socket;
}

Socket connect_to(const Endpoint& endpoint, std::chrono::milliseconds wait) {
  const Addresses found = resolve(endpoint, 0);
  std::string why = "no answer";
  for (const addrinfo* next = found.get(); next != nullptr; next = next->ai_next) {
    if (Socket socket = connect_to(*next, wait, why)) return socket;
  }
  throw unreachable(endpoint, why);
}

std::pair<Socket, Socket> socket_pair() {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw Error(ExitStatus::Unavailable, fmt::format("no socket pair: {}", std::strerror(errno)));
  }
  return {Socket(ends[0]), Socket(ends[1])};
}

void set_patience(const Socket& socket, std::chrono::milliseconds wait) noexcept {
  const timeval time{wait.count() / 1000, wait.count() % 1000 * 1000};
  setsockopt(socket.descriptor(), SOL_SOCKET, SO_RCVTIMEO, &time, sizeof time);
}

Received receive(const Socket& socket, std::span<std::uint8_t> room, std::size_t& count) noexcept {
  for (;;) {
    const ssize_t got = recv(socket.descriptor(), room.data(), room.size(), 0);
    if (got > 0) {
      count = static_cast<std::size_t>(got);
      return Received::Some;
    }
    if (got == 0) return Received::Closed;
    if (errno == EAGAIN || errno == EWOULDBLOCK) return Received::TimedOut;
    if (errno != EINTR) return Received::Closed;
  }
}

Sent send(const Socket& socket, std::span<const std::uint8_t> head, std::span<const std::uint8_t> body, bool may_drop,
          std::chrono::milliseconds wait) noexcept {
  std::size_t done = 0;
  const std::size_t whole = head.size() + body.size();
  const auto end = std::chrono::steady_clock::now() + wait +
                   std::chrono::milliseconds(std::llround(1e3 * static_cast<double>(whole) / kSlowest_bytes_s));
  while (done < whole) {
    // sendmsg does not write through these pointers.
    std::array<iovec, 2> parts{};
    std::size_t count = 0;
    if (done < head.size()) {
      parts[count++] = {const_cast<std::uint8_t*>(head.data()) + done, head.size() - done};
    }
    const std::size_t body_done = done < head.size() ? 0 : done - head.size();
    if (body_done < body.size()) {
      parts[count++] = {const_cast<std::uint8_t*>(body.data()) + body_done, body.size() - body_done};
    }
    msghdr message{};
    message.msg_iov = parts.data();
    message.msg_iovlen = count;
    const ssize_t sent = sendmsg(socket.descriptor(), &message, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent >= 0) {
      done += static_cast<std::size_t>(sent);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      if (done == 0 && may_drop) return Sent::None;
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
      if (left.count() <= 0 || !wait_for(socket, POLLOUT, std::min(left, wait))) return Sent::Failed;
    } else if (errno != EINTR) {
      return Sent::Failed;
    }
  }
  return Sent::All;
}

void shut_down(const Socket& socket) noexcept {
  if (socket) shutdown(socket.descriptor(), SHUT_RDWR);
}

}  // namespace myotact::net
