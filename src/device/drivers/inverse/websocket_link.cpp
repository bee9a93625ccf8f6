#include <optional>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <fmt/format.h>

#include "device/drivers/inverse/messages.h"
#include "device/drivers/inverse/service_link.h"

namespace myotact::device::inverse {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using Failure = boost::system::error_code;

/// On this machine all of these take less than a millisecond, unless a program hangs.
constexpr std::chrono::milliseconds kConnectWait(500);
constexpr std::chrono::milliseconds kVersionWait(300);
constexpr std::chrono::milliseconds kSendWait(100);
constexpr std::chrono::milliseconds kCloseWait(200);
constexpr std::size_t kMostVersionAnswer = 8192;  // bytes

/// Everything runs in the calls themselves, on the caller's thread: no operation but a read outlives one.
class WebSocketLink : public ServiceLink {
 public:
  explicit WebSocketLink(const InverseSettings& settings)
      : address_(asio::ip::make_address(settings.address)),
        port_(settings.port),
        version_port_(settings.version_port),
        timer_(context_) {}
  ~WebSocketLink() override { close(); }
  WebSocketLink(const WebSocketLink&) = delete;
  WebSocketLink& operator=(const WebSocketLink&) = delete;

  void connect() override;
  bool send(const std::string& text) override;
  LinkEvent receive(std::string& text, std::chrono::nanoseconds wait) override;
  std::string ask_version() override;
  void close() noexcept override;

 private:
  using Socket = websocket::stream<beast::tcp_stream>;

  /// Runs handlers until `finished`; one that makes it so must be on its way.
  template <class Finished>
  void run_until(const Finished& finished);
  /// Runs until `finished` or for `wait`. By a timer: the wait of the context itself is in whole milliseconds.
  template <class Finished>
  bool run(const Finished& finished, std::chrono::nanoseconds wait);
  /// Runs one operation that `start` begins with a handler; those that take longer than `wait` fail.
  template <class Start>
  Failure finish(const Start& start, std::chrono::nanoseconds wait);
  void shake_hands();
  void read_next();
  void drop() noexcept;

  const asio::ip::address address_;
  const std::uint16_t port_, version_port_;
  asio::io_context context_{1};
  asio::steady_timer timer_;
  std::optional<Socket> socket_;
  beast::flat_buffer buffer_{kLongestMessage};
  bool is_reading_ = false;
  bool has_message_ = false;
  bool has_ended_ = true;
};

template <class Finished>
void WebSocketLink::run_until(const Finished& finished) {
  while (!finished()) {
    context_.restart();
    context_.run_one();
  }
}

template <class Finished>
bool WebSocketLink::run(const Finished& finished, std::chrono::nanoseconds wait) {
  context_.restart();
  context_.poll();
  if (finished()) return true;
  if (wait <= std::chrono::nanoseconds::zero()) return false;
  bool is_late = false, is_waiting = true;
  timer_.expires_after(wait);
  timer_.async_wait([&](Failure failure) {
    is_waiting = false;
    is_late = !failure;
  });
  run_until([&] { return finished() || is_late; });
  timer_.cancel();
  run_until([&] { return !is_waiting; });
  return finished();
}

template <class Start>
Failure WebSocketLink::finish(const Start& start, std::chrono::nanoseconds wait) {
  std::optional<Failure> result;
  const auto is_finished = [&] { return result.has_value(); };
  start([&](Failure failure) { result = failure; });
  if (run(is_finished, wait)) return *result;
  drop();  // the handler is called all the same, with a failure
  run_until(is_finished);
  return beast::error::timeout;
}

void WebSocketLink::connect() {
  close();
  socket_.emplace(context_);
  const Tcp::endpoint there(address_, port_);
  const Failure failure =
      finish([&](auto done) { beast::get_lowest_layer(*socket_).async_connect(there, std::move(done)); }, kConnectWait);
  if (failure) {
    close();
    const bool refused = failure == boost::system::errc::connection_refused;
    throw ServiceError(refused ? fmt::format("nothing listens on {}:{}", address_.to_string(), port_)
                               : fmt::format("{}:{}: {}", address_.to_string(), port_, failure.message()),
                       "start the Inverse Service: \"sudo systemctl start haply-inverse-service\"; it is on "
                       "docs.haply.co where it is not installed");
  }
  shake_hands();
  has_ended_ = false;
}

void WebSocketLink::shake_hands() {
  Failure failure;
  beast::get_lowest_layer(*socket_).socket().set_option(Tcp::no_delay(true), failure);
  socket_->set_option(websocket::stream_base::timeout{kConnectWait, websocket::stream_base::none(), false});
  socket_->read_message_max(kLongestMessage);
  socket_->text(true);
  const std::string host = fmt::format("{}:{}", address_.to_string(), port_);
  failure = finish([&](auto done) { socket_->async_handshake(host, "/", std::move(done)); }, kConnectWait);
  if (!failure) return;
  close();
  throw ServiceError(fmt::format("what listens on {} is no WebSocket ({})", host, failure.message()),
                     "stop that program, or give the port of the Inverse Service");
}

bool WebSocketLink::send(const std::string& text) {
  if (has_ended_) return false;
  const Failure failure = finish(
      [&](auto done) {
        socket_->async_write(asio::buffer(text),
                             [done = std::move(done)](Failure result, std::size_t) mutable { done(result); });
      },
      kSendWait);
  if (failure) has_ended_ = true;
  return !failure;
}

void WebSocketLink::read_next() {
  is_reading_ = true;
  socket_->async_read(buffer_, [this](Failure failure, std::size_t) {
    is_reading_ = false;
    has_message_ = !failure;
    if (failure) has_ended_ = true;
  });
}

LinkEvent WebSocketLink::receive(std::string& text, std::chrono::nanoseconds wait) {
  if (has_ended_) return LinkEvent::Ended;
  if (!is_reading_ && !has_message_) read_next();
  run([this] { return has_message_ || has_ended_; }, wait);
  if (!has_message_) return has_ended_ ? LinkEvent::Ended : LinkEvent::Nothing;
  text.assign(static_cast<const char*>(buffer_.data().data()), buffer_.size());
  buffer_.clear();
  has_message_ = false;
  return LinkEvent::Message;
}

std::string WebSocketLink::ask_version() {
  asio::io_context context;
  beast::tcp_stream stream(context);
  stream.expires_after(kVersionWait);
  http::request<http::empty_body> request(http::verb::get, "/3.0/version", 11);
  request.set(http::field::host, fmt::format("{}:{}", address_.to_string(), version_port_));
  request.set(http::field::connection, "close");
  http::response_parser<http::string_body> answer;
  answer.body_limit(kMostVersionAnswer);
  beast::flat_buffer buffer(2 * kMostVersionAnswer);
  bool is_whole = false;
  stream.async_connect(Tcp::endpoint(address_, version_port_), [&](Failure refused) {
    if (refused) return;
    http::async_write(stream, request, [&](Failure unsent, std::size_t) {
      if (unsent) return;
      http::async_read(stream, buffer, answer, [&](Failure broken, std::size_t) { is_whole = !broken; });
    });
  });
  context.run();
  return is_whole && answer.get().result() == http::status::ok ? answer.get().body() : "";
}

/// Ends the connection now; operations under way fail.
void WebSocketLink::drop() noexcept {
  if (socket_) beast::get_lowest_layer(*socket_).close();
  has_ended_ = true;
}

void WebSocketLink::close() noexcept {
  if (!socket_) return;
  try {
    if (!has_ended_ && socket_->is_open()) {
      finish([&](auto done) { socket_->async_close(websocket::close_code::normal, std::move(done)); }, kCloseWait);
    }
    drop();
    run_until([this] { return !is_reading_; });
  } catch (const std::exception&) {  // out of memory: the stream goes with whatever it holds
  }
  socket_.reset();
  buffer_.clear();
  has_message_ = false;
}

}  // namespace

std::unique_ptr<ServiceLink> make_websocket_link(const InverseSettings& settings) {
  Failure failure;
  const auto address = asio::ip::make_address(settings.address, failure);
  if (failure || !address.is_loopback()) {
    throw Error(
        ExitStatus::Usage,
        fmt::format("the Inverse Service's address \"{}\" is no numeric address of this machine; use 127.0.0.1, "
                    "127.0.0.2 .. 127.255.255.254 or ::1",
                    settings.address));
  }
  return std::make_unique<WebSocketLink>(settings);
}

}  // namespace myotact::device::inverse
