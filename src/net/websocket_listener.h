#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "net/socket.h"
#include "net/web_files.h"

namespace myotact::net {

class Server;

/// Lets browsers and engines join a server: every binary message of a WebSocket (RFC 6455) is a piece of the same
/// stream of frames that TCP carries, and every frame of the server is one message.
///
/// Where files are given it serves them too, over HTTP on the same port: a page for browsers, which joins by the same
/// WebSocket.
///
/// A page of another site cannot use it: the Host must be an address or a name of this machine, and a browser's Origin
/// of the same host, or one that is allowed.
class WebSocketListener {
 public:
  /// Listens from now on; `server` outlives it. `origins`: of pages elsewhere that may connect, as
  /// "https://lab.example". Throws Error Unavailable.
  WebSocketListener(const Endpoint& endpoint, Server& server, std::vector<std::string> origins = {},
                    WebFiles files = {});
  ~WebSocketListener();
  WebSocketListener(const WebSocketListener&) = delete;
  WebSocketListener& operator=(const WebSocketListener&) = delete;

  std::uint16_t port() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether this machine is meant by a request's Host: its own name, or an address in numbers. A foreign name that
/// points here is a foreign page's.
bool is_own_host(const std::string& host);

/// Whether a request with these headers may become a WebSocket; an empty origin is a program's that is no browser.
bool may_open(const std::string& host, const std::string& origin, const std::vector<std::string>& origins);

}  // namespace myotact::net
