#include "net/websocket_listener.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "core/error.h"
#include "core/text.h"
#include "net/frame_reader.h"
#include "net/server.h"
#include "realtime/real_time_thread.h"

namespace myotact::net {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using Local = asio::local::stream_protocol;
using Failure = boost::system::error_code;

constexpr std::size_t kMostMessage = kHeaderBytes + kMostControl;  // that a client sends
constexpr std::size_t kMostRequest = 8192;                         // of the HTTP request
constexpr std::size_t kMostGuests = 512;                           // under way at once
constexpr std::size_t kCrowd = 256;                                // from here on a connection is for one request
constexpr std::size_t kMostOrigin = 128;                           // of it in a log
constexpr std::chrono::seconds kRequestWait(3);
constexpr std::chrono::seconds kFileWait(60);  // for all of one file on the slowest line
constexpr const char* kPlain = "text/plain; charset=utf-8";
constexpr std::chrono::milliseconds kNoRoom(50);  // until another connection may have left

/// "example.org" of "https://example.org:8080".
std::string host_of(const std::string& origin) {
  const std::size_t begin = origin.find("://");
  std::string rest = begin == std::string::npos ? origin : origin.substr(begin + 3);
  const std::size_t bracket = rest.find(']');
  const std::size_t colon = rest.find(':', bracket == std::string::npos ? 0 : bracket);
  return lower(rest.substr(0, colon));
}

bool is_own_name(const std::string& host) {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  if (host == "localhost" || host == lower(name.data())) return true;
  std::string number = host;
  if (number.size() > 2 && number.front() == '[') number = number.substr(1, number.size() - 2);
  Failure none;
  asio::ip::make_address(number, none);  // a number cannot be made to mean another machine, as a name can
  return !none;
}

/// What all guests are let in by.
struct House {
  Server& server;
  std::vector<std::string> origins;
  WebFiles files;
  std::atomic<std::size_t> guests{0};
};

/// One connection: requests for files, until one of them becomes a WebSocket with the server's end of its stream. Lives
/// as long as an operation of it is under way.
class Guest : public std::enable_shared_from_this<Guest> {
 public:
  Guest(Tcp::socket socket, House& house)
      : socket_(std::move(socket)), inner_(socket_.get_executor()), house_(house), server_(house.server) {
    ++house_.guests;
  }
  ~Guest() { --house_.guests; }

  void start() {
    Failure ignored;
    beast::get_lowest_layer(socket_).socket().set_option(Tcp::no_delay(true), ignored);
    read_request();
  }

 private:
  void read_request() {
    beast::get_lowest_layer(socket_).expires_after(kRequestWait);
    request_.emplace();
    request_->header_limit(kMostRequest);
    request_->body_limit(0);
    http::async_read(socket_.next_layer(), buffer_, *request_,
                     [self = shared_from_this()](Failure failure, std::size_t) { self->answer(failure); });
  }

  std::string header(http::field field) const { return std::string(request_->get()[field]); }

  void answer(Failure failure) {
    if (failure) return;
    if (websocket::is_upgrade(request_->get())) return open();
    if (!house_.files.empty()) answer_file();
  }

  /// The file that is asked for, or in a sentence why not.
  void answer_file() {
    const std::string path = std::string(request_->get().target()).substr(0, request_->get().target().find('?'));
    const auto found = house_.files.find(path);
    const auto method = request_->get().method();
    if (!is_own_host(header(http::field::host))) {
      return send_file(http::status::forbidden, web_file(kPlain, "Ask for this page by the machine's address."));
    }
    if (method != http::verb::get && method != http::verb::head) {
      return send_file(http::status::method_not_allowed, web_file(kPlain, "Files can be got here, nothing else."));
    }
    if (found == house_.files.end())
      return send_file(http::status::not_found, web_file(kPlain, "There is no such file."));
    if (header(http::field::if_none_match) == found->second.tag) {
      return send_file(http::status::not_modified, {found->second.content_type, "", "", found->second.tag});
    }
    send_file(http::status::ok, found->second);
  }

  void send_file(http::status status, const WebFile& file) {
    const bool is_packed = !file.gzip.empty() && header(http::field::accept_encoding).find("gzip") != std::string::npos;
    response_.emplace(status, request_->get().version());
    response_->set(http::field::content_type, file.content_type);
    response_->set(http::field::etag, file.tag);
    response_->set(http::field::cache_control, "no-cache");
    response_->set(http::field::vary, "Accept-Encoding");
    response_->set("Content-Security-Policy", security_policy(header(http::field::host)));
    response_->set("X-Content-Type-Options", "nosniff");
    response_->set("Referrer-Policy", "no-referrer");
    response_->set("Cross-Origin-Opener-Policy", "same-origin");
    response_->set("Cross-Origin-Resource-Policy", "same-origin");
    if (is_packed) response_->set(http::field::content_encoding, "gzip");
    const std::string& body = is_packed ? file.gzip : file.body;
    response_->content_length(body.size());
    if (request_->get().method() != http::verb::head) response_->body() = body;
    response_->keep_alive(request_->get().keep_alive() && house_.guests < kCrowd);
    beast::get_lowest_layer(socket_).expires_after(kFileWait);
    http::async_write(socket_.next_layer(), *response_, [self = shared_from_this()](Failure failure, std::size_t) {
      if (!failure && self->response_->keep_alive()) self->read_request();
    });
  }

  void open() {
    if (!may_open(header(http::field::host), header(http::field::origin), house_.origins)) {
      const std::string origin = header(http::field::origin).substr(0, kMostOrigin);
      if (server_.is_new_complaint("origin " + origin)) {
        spdlog::warn("a WebSocket of a page from \"{}\" was refused; --allow-origin lets it in (reported once)",
                     origin);
      }
      return send_file(http::status::forbidden,
                       web_file(kPlain, "Only a page of this server may join here, by the machine's address."));
    }
    beast::get_lowest_layer(socket_).expires_never();
    auto timeouts = websocket::stream_base::timeout::suggested(beast::role_type::server);
    timeouts.handshake_timeout = kRequestWait;
    timeouts.idle_timeout = std::chrono::seconds(10);
    socket_.set_option(timeouts);
    socket_.read_message_max(kMostMessage);
    socket_.binary(true);
    socket_.async_accept(request_->get(), [self = shared_from_this()](Failure refused) { self->join(refused); });
  }

  void join(Failure failure) {
    if (failure) return;
    auto [ours, theirs] = socket_pair();
    inner_.assign(Local(), ::dup(ours.descriptor()), failure);
    if (failure) return;
    const Tcp::endpoint peer = beast::get_lowest_layer(socket_).socket().remote_endpoint(failure);
    server_.adopt(std::move(theirs), failure ? "?" : peer.address().to_string());
    buffer_.clear();
    read_message();
    read_header();
  }

  void read_message() {
    socket_.async_read(buffer_, [self = shared_from_this()](Failure failure, std::size_t) {
      if (failure || !self->socket_.got_binary()) return self->end();
      asio::async_write(self->inner_, self->buffer_.data(), [self](Failure broken, std::size_t) {
        if (broken) return self->end();
        self->buffer_.clear();
        self->read_message();
      });
    });
  }

  void read_header() {
    frame_.resize(kHeaderBytes);
    asio::async_read(inner_, asio::buffer(frame_), [self = shared_from_this()](Failure failure, std::size_t) {
      FrameHeader header;
      const auto bytes = std::span<const std::uint8_t>(self->frame_).first<kHeaderBytes>();
      if (failure || parse_header(bytes, header) != WireFault::None) return self->close();
      self->frame_.resize(kHeaderBytes + header.length);
      self->read_payload();
    });
  }

  void read_payload() {
    asio::async_read(inner_, asio::buffer(frame_.data() + kHeaderBytes, frame_.size() - kHeaderBytes),
                     [self = shared_from_this()](Failure failure, std::size_t) {
                       if (failure) return self->close();
                       self->socket_.async_write(asio::buffer(self->frame_), [self](Failure broken, std::size_t) {
                         if (broken) return self->end();
                         self->read_header();
                       });
                     });
  }

  /// The server is done with the client: what it said last has been passed on.
  void close() {
    socket_.async_close(websocket::close_code::normal, [self = shared_from_this()](Failure) { self->end(); });
  }
  void end() {
    Failure ignored;
    inner_.close(ignored);
    beast::get_lowest_layer(socket_).close();
  }

  websocket::stream<beast::tcp_stream> socket_;
  Local::socket inner_;
  House& house_;
  Server& server_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> request_;
  std::optional<http::response<http::string_body>> response_;
  Bytes frame_;
};

}  // namespace

bool is_own_host(const std::string& host) {
  return is_own_name(host_of(host));
}

bool may_open(const std::string& host, const std::string& origin, const std::vector<std::string>& origins) {
  if (!is_own_host(host)) return false;
  if (origin.empty() || std::find(origins.begin(), origins.end(), origin) != origins.end()) return true;
  return host_of(origin) == host_of(host);
}

struct WebSocketListener::Impl {
  Impl(const Endpoint& endpoint, Server& server, std::vector<std::string> origins, WebFiles files)
      : house{server, std::move(origins), std::move(files)}, acceptor(context) {
    Socket listener = listen_at(endpoint);
    bound = port_of(listener);
    const bool is_v6 = endpoint.host.find(':') != std::string::npos;
    acceptor.assign(is_v6 ? Tcp::v6() : Tcp::v4(), ::dup(listener.descriptor()));
    accept();
    thread = std::thread([this] {
      realtime::name_this_thread("websockets");
      run();
    });
  }
  ~Impl() {
    context.stop();
    thread.join();
  }

  /// What one guest makes fail - no descriptor, no memory - is its own end only.
  void run() {
    while (!context.stopped()) {
      try {
        context.run();
      } catch (const std::exception& failure) {
        if (house.server.is_new_complaint(failure.what()))
          spdlog::warn("a WebSocket: {} (reported once)", failure.what());
      }
    }
  }

  void accept() {
    acceptor.async_accept([this](Failure failure, Tcp::socket socket) {
      if (failure == asio::error::operation_aborted) return;
      if (failure) {  // no descriptor is free: without a pause this would be tried again and again
        pause.expires_after(kNoRoom);
        pause.async_wait([this](Failure) { accept(); });
        return;
      }
      if (house.guests < kMostGuests) std::make_shared<Guest>(std::move(socket), house)->start();
      accept();
    });
  }

  House house;
  asio::io_context context{1};
  Tcp::acceptor acceptor;
  asio::steady_timer pause{context};
  std::uint16_t bound = 0;
  std::thread thread;
};

WebSocketListener::WebSocketListener(const Endpoint& endpoint, Server& server, std::vector<std::string> origins,
                                     WebFiles files)
    : impl_(std::make_unique<Impl>(endpoint, server, std::move(origins), std::move(files))) {}

WebSocketListener::~WebSocketListener() = default;

std::uint16_t WebSocketListener::port() const {
  return impl_->bound;
}

}  // namespace myotact::net
