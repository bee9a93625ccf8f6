#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <string_view>

#include "core/error.h"
#include "device/drivers/inverse/settings.h"

namespace myotact::device::inverse {

/// Why the service cannot be talked with, and what to do about it: one sentence each.
class ServiceError : public Error {
 public:
  ServiceError(const std::string& why, const std::string& what_to_do)
      : Error(ExitStatus::Unavailable, why + "; " + what_to_do), cause(why), remedy(what_to_do) {}
  const std::string cause, remedy;
};

enum class LinkEvent { Message, Nothing, Ended };

/// One WebSocket to the Inverse Service. One thread at a time.
class ServiceLink {
 public:
  virtual ~ServiceLink() = default;
  /// A new connection; the old one, if any, is closed. Throws ServiceError, within about a second.
  virtual void connect() = 0;
  /// One message of text. False: the connection has ended.
  virtual bool send(const std::string& text) = 0;
  /// Waits for the next message, at most `wait`.
  virtual LinkEvent receive(std::string& text, std::chrono::nanoseconds wait) = 0;
  /// What the service answers over HTTP when it is asked for its version; empty when it does not.
  virtual std::string ask_version() = 0;
  virtual void close() noexcept = 0;
};

/// Throws Error Usage when the address is no numeric loopback address: the protocol has neither password nor cipher.
std::unique_ptr<ServiceLink> make_websocket_link(const InverseSettings& settings);

}  // namespace myotact::device::inverse
