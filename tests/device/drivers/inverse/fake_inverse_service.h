#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/vector.h"

namespace myotact::device::inverse {

/// How the service answers a command.
enum class Manner { States, Silence, Garbage, Truncated };

/// What it was told so far.
struct Received {
  int connections = 0;
  std::uint64_t commands = 0;      // of all connections
  std::uint64_t values_forms = 0;  // of them: forces under "values"
  std::uint64_t vector_forms = 0;  // of them: forces under "vector"
  double greatest_N = 0.0;         // largest force of all
  Vec3 last_N = Vec3::Zero();      // in the service's frame
  std::string last_id;
  int zeros_first = 0;     // commands of zero force before the first other one, of this connection
  bool has_force = false;  // this connection had a force that is not zero
};

/// An Inverse Service of the test's on a free port of this machine: an inventory when a connection begins, then one
/// state for each command. Every device goes to and fro along its x, 0.1 mm a state. Any thread.
class FakeInverseService {
 public:
  /// `port` 0: any free one.
  explicit FakeInverseService(std::vector<std::string> devices, std::uint16_t port = 0);
  ~FakeInverseService();

  std::uint16_t port() const;
  void set_devices(std::vector<std::string> devices);
  void set_manner(Manner manner);
  /// Buttons of the first grip, as members of JSON: "\"a\":true".
  void set_buttons(const std::string& members);
  /// Told in the inventory.
  void set_version(const std::string& version);
  /// Ends the connection in the middle of whatever it does, without a goodbye.
  void cut();
  Received received() const;

 private:
  class Inside;
  std::unique_ptr<Inside> inside_;
};

/// Listens on a free port and answers every connection with `answer`, whatever is asked: an HTTP version, or a program
/// that is no service.
class FakeAnswer {
 public:
  explicit FakeAnswer(std::string answer);
  ~FakeAnswer();
  std::uint16_t port() const;

 private:
  class Inside;
  std::unique_ptr<Inside> inside_;
};

/// A port that is taken and on which nothing listens: it refuses every connection for as long as this lives.
class ClosedPort {
 public:
  ClosedPort();
  ~ClosedPort();
  std::uint16_t port() const;

 private:
  class Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace myotact::device::inverse
