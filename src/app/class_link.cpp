#include "app/class_link.h"

#include <array>
#include <optional>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <sys/socket.h>

#include "view/ui/qr_code.h"

namespace myotact::app {

std::string class_link(const net::Endpoint& page, const std::optional<net::Token>& token, const std::string& role) {
  const bool is_v6 = page.host.find(':') != std::string::npos;
  std::string link = fmt::format("http://{}:{}/", is_v6 ? "[" + page.host + "]" : page.host, page.port);
  std::string fragment;
  if (token) fragment = "token=" + net::to_text(*token);
  if (role != "student") fragment += (fragment.empty() ? "role=" : "&role=") + role;
  return fragment.empty() ? link : link + "#" + fragment;
}

std::string reachable_address(const std::string& bind) {
  if (bind != "0.0.0.0" && bind != "::") return bind;
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return bind;
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> all(first, &freeifaddrs);
  for (const ifaddrs* one = first; one != nullptr; one = one->ifa_next) {
    const bool is_up = (one->ifa_flags & IFF_UP) != 0 && (one->ifa_flags & IFF_LOOPBACK) == 0;
    if (!is_up || one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    const auto* address = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    if (inet_ntop(AF_INET, &address->sin_addr, text.data(), text.size()) != nullptr) return text.data();
  }
  return "127.0.0.1";
}

std::string qr_for_terminal(const std::string& text) {
  constexpr int kQuiet = 2;  // cells of margin; the standard asks for 4, and readers make do with 2
  const std::optional<view::QrCode> code = view::qr_code(text);
  if (!code) return "";
  // Half blocks: upper, lower, both.
  constexpr std::array<const char*, 4> kBlocks = {" ", "\u2580", "\u2584", "\u2588"};
  std::string lines;
  for (int row = -kQuiet; row < code->width + kQuiet; row += 2) {
    for (int column = -kQuiet; column < code->width + kQuiet; ++column) {
      lines += kBlocks[(code->is_dark(row, column) ? 0u : 1u) | (code->is_dark(row + 1, column) ? 0u : 2u)];
    }
    lines += '\n';
  }
  return lines;
}

}  // namespace myotact::app
