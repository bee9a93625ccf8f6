#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "device/drivers/spacemouse/hid_port.h"

namespace myotact::device::spacemouse {

/// A USB port of the test's: what is plugged in sends what the test says.
class FakeBus : public HidBus {
 public:
  using Bytes = std::vector<std::uint8_t>;

  void plug(const HidEntry& entry) {
    const std::lock_guard lock(mutex_);
    entries_.push_back(entry);
  }
  void unplug_all() {
    const std::lock_guard lock(mutex_);
    entries_.clear();
    pending_.clear();
  }
  void send(const Bytes& report) {
    const std::lock_guard lock(mutex_);
    pending_.push_back(report);
  }
  bool all_read() const {
    const std::lock_guard lock(mutex_);
    return pending_.empty();
  }
  std::vector<Bytes> written() const {
    const std::lock_guard lock(mutex_);
    return written_;
  }

  std::vector<HidEntry> list() override {
    const std::lock_guard lock(mutex_);
    return entries_;
  }
  std::unique_ptr<HidPort> open(const std::string& path) override {
    const std::lock_guard lock(mutex_);
    for (const HidEntry& entry : entries_) {
      if (entry.path == path) return std::make_unique<Port>(*this, path);
    }
    throw Error(ExitStatus::Unavailable, path + ": nothing there; plug it in");
  }

 private:
  class Port : public HidPort {
   public:
    Port(FakeBus& bus, std::string path) : bus_(bus), path_(std::move(path)) {}
    int read(std::span<std::uint8_t> report) noexcept override {
      const std::lock_guard lock(bus_.mutex_);
      bool is_there = false;
      for (const HidEntry& entry : bus_.entries_) is_there |= entry.path == path_;
      if (!is_there) return -1;
      if (bus_.pending_.empty()) return 0;
      const Bytes bytes = bus_.pending_.front();
      bus_.pending_.pop_front();
      std::copy(bytes.begin(), bytes.end(), report.begin());
      return static_cast<int>(bytes.size());
    }
    bool write(std::span<const std::uint8_t> report) noexcept override {
      const std::lock_guard lock(bus_.mutex_);
      bus_.written_.emplace_back(report.begin(), report.end());
      return true;
    }

   private:
    FakeBus& bus_;
    std::string path_;
  };

  mutable std::mutex mutex_;
  std::vector<HidEntry> entries_;
  std::deque<Bytes> pending_;
  std::vector<Bytes> written_;
};

inline HidEntry compact(const std::string& path) {
  HidEntry entry;
  entry.path = path;
  entry.vendor = 0x256F;
  entry.product = 0xC635;
  entry.usage_page = 1;
  entry.usage = 8;
  return entry;
}

}  // namespace myotact::device::spacemouse
