#include "device/drivers/inverse/fake_inverse_service.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <thread>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/socket.h>

namespace myotact::device::inverse {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using Failure = boost::system::error_code;
using Socket = websocket::stream<Tcp::socket>;

Tcp::endpoint loopback(std::uint16_t port) {
  return {asio::ip::address_v4::loopback(), port};
}

}  // namespace

/// One thread with blocking calls; a shutdown of the sockets from outside ends them.
class FakeInverseService::Inside {
 public:
  Inside(std::vector<std::string> devices, std::uint16_t port)
      : acceptor_(context_, loopback(port)), devices_(std::move(devices)), thread_([this] { serve(); }) {}
  ~Inside() {
    closing_ = true;
    ::shutdown(acceptor_.native_handle(), SHUT_RDWR);
    cut();
    thread_.join();
  }

  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }
  void cut() {
    const std::lock_guard lock(mutex_);
    if (open_socket_ >= 0) ::shutdown(open_socket_, SHUT_RDWR);
  }
  template <class Change>
  auto with_lock(const Change& change) const {
    const std::lock_guard lock(mutex_);
    return change();
  }

  std::vector<std::string>& devices() { return devices_; }
  Manner& manner() { return manner_; }
  std::string& buttons() { return buttons_; }
  std::string& version() { return version_; }
  const Received& received() const { return received_; }

 private:
  void serve() {
    while (!closing_) {
      Failure failure;
      Tcp::socket socket(context_);
      acceptor_.accept(socket, failure);
      if (failure || closing_) return;
      socket.set_option(Tcp::no_delay(true), failure);
      with_lock([&] { open_socket_ = socket.native_handle(); });
      talk(Socket(std::move(socket)));
      with_lock([&] { open_socket_ = -1; });
    }
  }

  void talk(Socket socket) {
    Failure failure;
    socket.accept(failure);
    if (failure) return;
    with_lock([&] {
      ++received_.connections;
      received_.zeros_first = 0;
      received_.has_force = false;
    });
    socket.text(true);
    socket.write(asio::buffer(message(true)), failure);
    beast::flat_buffer buffer;
    while (!failure) {
      buffer.clear();
      socket.read(buffer, failure);
      if (failure) return;
      note(beast::buffers_to_string(buffer.data()));
      const std::string answer = message(false);
      if (!answer.empty()) socket.write(asio::buffer(answer), failure);
    }
  }

  void note(const std::string& text) {
    const auto command = nlohmann::json::parse(text).at("inverse3").at(0);
    const auto& set = command.at("commands").at("set_cursor_force");
    const std::lock_guard lock(mutex_);
    ++received_.commands;
    if (set.contains("values")) ++received_.values_forms;
    if (set.contains("vector")) ++received_.vector_forms;
    const auto& force = *set.begin();
    received_.last_id = command.at("device_id").get<std::string>();
    received_.last_N = Vec3(force.at("x").get<double>(), force.at("y").get<double>(), force.at("z").get<double>());
    received_.greatest_N = std::max(received_.greatest_N, received_.last_N.norm());
    received_.has_force |= received_.last_N != Vec3::Zero();
    if (!received_.has_force) ++received_.zeros_first;
  }

  std::string message(bool is_inventory) {
    const std::lock_guard lock(mutex_);
    if (!is_inventory && manner_ == Manner::Silence) return "";
    if (!is_inventory && manner_ == Manner::Garbage) return "{\"inverse3\": 7}";
    const double x_m = 0.01 * std::sin(0.01 * static_cast<double>(states_++));
    auto list = nlohmann::json::array();
    for (const std::string& id : devices_) {
      auto device =
          nlohmann::json{{"device_id", id}, {"state", {{"cursor_position", {{"x", x_m}, {"y", -0.15}, {"z", 0.2}}}}}};
      if (is_inventory) device["config"] = {{"handedness", "right"}, {"port", "/dev/ttyACM0"}};
      list.push_back(device);
    }
    nlohmann::json json = {{"session_id", received_.connections}, {"inverse3", list}};
    json["wireless_verse_grip"] = nlohmann::json::array(
        {{{"device_id", "61"}, {"state", {{"buttons", nlohmann::json::parse("{" + buttons_ + "}")}}}}});
    if (is_inventory && !version_.empty()) json["version"] = version_;
    const std::string text = json.dump();
    return !is_inventory && manner_ == Manner::Truncated ? text.substr(0, text.size() / 2) : text;
  }

  asio::io_context context_;
  Tcp::acceptor acceptor_;
  mutable std::mutex mutex_;
  std::vector<std::string> devices_;
  Manner manner_ = Manner::States;
  std::string buttons_, version_;
  Received received_;
  int open_socket_ = -1;
  std::uint64_t states_ = 0;
  std::atomic<bool> closing_{false};
  std::thread thread_;  // last: it runs from the constructor on
};

FakeInverseService::FakeInverseService(std::vector<std::string> devices, std::uint16_t port)
    : inside_(std::make_unique<Inside>(std::move(devices), port)) {}
FakeInverseService::~FakeInverseService() = default;

std::uint16_t FakeInverseService::port() const {
  return inside_->port();
}
void FakeInverseService::set_devices(std::vector<std::string> devices) {
  inside_->with_lock([&] { inside_->devices() = std::move(devices); });
}
void FakeInverseService::set_manner(Manner manner) {
  inside_->with_lock([&] { inside_->manner() = manner; });
}
void FakeInverseService::set_buttons(const std::string& members) {
  inside_->with_lock([&] { inside_->buttons() = members; });
}
void FakeInverseService::set_version(const std::string& version) {
  inside_->with_lock([&] { inside_->version() = version; });
}
void FakeInverseService::cut() {
  inside_->cut();
}
Received FakeInverseService::received() const {
  return inside_->with_lock([&] { return inside_->received(); });
}

class FakeAnswer::Inside {
 public:
  explicit Inside(std::string answer)
      : acceptor_(context_, loopback(0)), answer_(std::move(answer)), thread_([this] { serve(); }) {}
  ~Inside() {
    closing_ = true;
    ::shutdown(acceptor_.native_handle(), SHUT_RDWR);
    thread_.join();
  }
  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

 private:
  void serve() {
    while (!closing_) {
      Failure failure;
      Tcp::socket socket(context_);
      acceptor_.accept(socket, failure);
      if (failure || closing_) return;
      std::array<char, 4096> question{};
      socket.read_some(asio::buffer(question), failure);
      asio::write(socket, asio::buffer(answer_), failure);
    }
  }

  asio::io_context context_;
  Tcp::acceptor acceptor_;
  std::string answer_;
  std::atomic<bool> closing_{false};
  std::thread thread_;  // last: it runs from the constructor on
};

FakeAnswer::FakeAnswer(std::string answer) : inside_(std::make_unique<Inside>(std::move(answer))) {}
FakeAnswer::~FakeAnswer() = default;
std::uint16_t FakeAnswer::port() const {
  return inside_->port();
}

class ClosedPort::Inside {
 public:
  Inside() : socket_(context_, loopback(0)) {}
  std::uint16_t port() const { return socket_.local_endpoint().port(); }

 private:
  asio::io_context context_;
  Tcp::socket socket_;  // bound, never listening
};

ClosedPort::ClosedPort() : inside_(std::make_unique<Inside>()) {}
ClosedPort::~ClosedPort() = default;
std::uint16_t ClosedPort::port() const {
  return inside_->port();
}

}  // namespace myotact::device::inverse
