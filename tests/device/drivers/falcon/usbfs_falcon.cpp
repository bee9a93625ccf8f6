#include "usbfs_falcon.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <span>
#include <stdexcept>

#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>

namespace myotact::device::falcon {

namespace {

constexpr const char* kNode = "/dev/bus/usb/001/002";
constexpr const char* kPath = "/sys/devices/pci0000:00/0000:00:14.0/usb1/1-1";
constexpr unsigned char kInEndpoint = 0x81;
constexpr std::uint8_t kVendorRequest = 0x40;
constexpr std::uint8_t kLatencyRequest = 9;  // after how long [ms] the chip sends its status alone

// Descriptors of the device, its configuration, its interface and its two bulk endpoints, as of a serial chip.
constexpr const char* kRecord =
    "P: /devices/pci0000:00/0000:00:14.0/usb1/1-1\nN: bus/usb/001/002\n"
    "E: DEVNAME=/dev/bus/usb/001/002\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nE: BUSNUM=001\nE: DEVNUM=002\n"
    "E: PRODUCT=403/cb48/400\nA: busnum=1\\n\nA: devnum=2\\n\nA: speed=12\\n\nA: bConfigurationValue=1\\n\n"
    "A: idVendor=0403\\n\nA: idProduct=cb48\\n\nA: product=FALCON HAPTIC\\n\n"
    "H: descriptors=12010002000000080304"
    "48CB00040000000109022000010100802D"
    "0904000002FFFFFF000705810240000007050202400000\n\n";

usbdevfs_urb& fields_of(UMockdevIoctlData* urb) {
  return *reinterpret_cast<usbdevfs_urb*>(urb->data);
}

std::span<std::uint8_t> bytes_of(UMockdevIoctlData* data) {
  return {data->data, static_cast<std::size_t>(data->data_len)};
}

}  // namespace

UsbfsFalcon::UsbfsFalcon() : bed_(umockdev_testbed_new()), handler_(umockdev_ioctl_base_new()) {
  g_signal_connect(handler_, "handle-ioctl", G_CALLBACK(on_ioctl), this);
  g_signal_connect(handler_, "client-vanished", G_CALLBACK(on_vanished), this);
  if (!umockdev_testbed_attach_ioctl(bed_, kNode, handler_, nullptr)) throw std::runtime_error("attach_ioctl failed");
}

UsbfsFalcon::~UsbfsFalcon() {
  umockdev_testbed_detach_ioctl(bed_, kNode, nullptr);
  g_signal_handlers_disconnect_by_data(handler_, this);
  g_object_unref(handler_);
  g_object_unref(bed_);
  for (Block& block : blocks_) drop(block);
}

void UsbfsFalcon::plug() {
  {
    const std::lock_guard lock(mutex_);
    is_plugged_ = true;
  }
  if (!umockdev_testbed_add_from_string(bed_, kRecord, nullptr)) throw std::runtime_error("add_from_string failed");
}

void UsbfsFalcon::unplug() {
  {
    const std::lock_guard lock(mutex_);
    is_plugged_ = false;
    for (Block& block : blocks_)
      if (!block.is_done) finish(block, -ESHUTDOWN, 0);
  }
  umockdev_testbed_remove_device(bed_, kPath);
}

void UsbfsFalcon::stall_in() {
  const std::lock_guard lock(mutex_);
  in_stalls_ = true;
}

void UsbfsFalcon::stall_out() {
  const std::lock_guard lock(mutex_);
  out_is_halted_ = true;
}

void UsbfsFalcon::let_another_have_it(bool has) {
  const std::lock_guard lock(mutex_);
  another_has_it_ = has;
}

gboolean UsbfsFalcon::on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, UsbfsFalcon* self) {
  const Answer answer = self->answer(client);
  umockdev_ioctl_client_complete(client, answer.result, answer.error);
  return TRUE;
}

void UsbfsFalcon::on_vanished(UMockdevIoctlBase*, UMockdevIoctlClient* client, UsbfsFalcon* self) {
  const std::lock_guard lock(self->mutex_);
  if (self->owner_ == client) self->owner_ = nullptr;
  std::erase_if(self->blocks_, [client](Block& block) {
    if (block.client == client) drop(block);
    return block.client == client;
  });
}

UsbfsFalcon::Answer UsbfsFalcon::answer(UMockdevIoctlClient* client) {
  const std::lock_guard lock(mutex_);
  const auto request = umockdev_ioctl_client_get_request(client);
  if (request == USBDEVFS_REAPURBNDELAY) return reap(client);
  if (request == USBDEVFS_DISCARDURB) return discard(client);
  if (!is_plugged_) return {-1, ENODEV};
  switch (request) {
    case USBDEVFS_GET_CAPABILITIES:
      return capabilities(client);
    case USBDEVFS_CLAIMINTERFACE:
      return claim(client);
    case USBDEVFS_RELEASEINTERFACE:
      if (owner_ == client) owner_ = nullptr;
      return {0, 0};
    case USBDEVFS_SUBMITURB:
      return submit(client);
    case USBDEVFS_CLEAR_HALT:
      return clear_halt(client);
    default:
      return {-1, ENOTTY};
  }
}

UsbfsFalcon::Answer UsbfsFalcon::capabilities(UMockdevIoctlClient* client) {
  UMockdevIoctlData* value =
      umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, sizeof(__u32), nullptr);
  const __u32 all =
      USBDEVFS_CAP_BULK_CONTINUATION | USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
  std::memcpy(value->data, &all, sizeof all);
  umockdev_ioctl_data_unref(value);
  return {0, 0};
}

UsbfsFalcon::Answer UsbfsFalcon::claim(UMockdevIoctlClient* client) {
  if (another_has_it_ || (owner_ != nullptr && owner_ != client)) return {-1, EBUSY};
  owner_ = client;
  return {0, 0};
}

UsbfsFalcon::Answer UsbfsFalcon::submit(UMockdevIoctlClient* client) {
  Block block;
  block.client = client;
  block.urb = umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, sizeof(usbdevfs_urb), nullptr);
  const usbdevfs_urb& fields = fields_of(block.urb);
  block.buffer = umockdev_ioctl_data_resolve(block.urb, offsetof(usbdevfs_urb, buffer),
                                             static_cast<gsize>(fields.buffer_length), nullptr);
  block.is_receipt = fields.endpoint == kInEndpoint;
  if (!block.is_receipt) serve(block);
  blocks_.push_back(block);
  const auto queued = static_cast<std::size_t>(
      std::count_if(blocks_.begin(), blocks_.end(), [](const Block& b) { return b.is_receipt && !b.is_done; }));
  most_queued_ = std::max(most_queued_, queued);
  return {0, 0};
}

/// What goes to the device is done at once.
void UsbfsFalcon::serve(Block& block) {
  const auto bytes = bytes_of(block.buffer);
  if (fields_of(block.urb).type == USBDEVFS_URB_TYPE_CONTROL) {
    const auto value = static_cast<std::uint16_t>(bytes[2] | bytes[3] << 8);
    const bool takes = bytes[0] == kVendorRequest && fake_.request(bytes[1], value);
    if (takes && bytes[1] == kLatencyRequest) latency_ = std::chrono::milliseconds(value);
    return finish(block, takes ? 0 : -EPIPE, 0);
  }
  if (out_is_halted_) return finish(block, -EPIPE, 0);
  if (fake_.send(bytes)) finish(block, 0, static_cast<int>(bytes.size()));  // else it hangs until it is taken back
}

void UsbfsFalcon::fill_receipt(Block& block) {
  if (in_stalls_) {
    in_stalls_ = false;
    in_is_halted_ = true;
    return finish(block, -EPIPE, 0);
  }
  if (in_is_halted_) return;
  auto bytes = bytes_of(block.buffer);
  std::size_t count = fake_.receive(bytes, std::chrono::milliseconds(0));
  if (count == 0 && Clock::now() - last_receipt_ >= latency_) {
    bytes[0] = 0x01;
    bytes[1] = 0x60;
    count = kStatusBytes;
  }
  if (count == 0) return;
  last_receipt_ = Clock::now();
  finish(block, 0, static_cast<int>(count));
}

UsbfsFalcon::Answer UsbfsFalcon::reap(UMockdevIoctlClient* client) {
  const auto waiting = std::find_if(blocks_.begin(), blocks_.end(), [client](const Block& block) {
    return block.client == client && block.is_receipt && !block.is_done;
  });
  if (is_plugged_ && waiting != blocks_.end()) fill_receipt(*waiting);
  const auto done = std::find_if(blocks_.begin(), blocks_.end(),
                                 [client](const Block& block) { return block.client == client && block.is_done; });
  if (done == blocks_.end()) return {-1, is_plugged_ ? EAGAIN : ENODEV};
  UMockdevIoctlData* target =
      umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, sizeof(void*), nullptr);
  umockdev_ioctl_data_set_ptr(target, 0, done->urb);
  umockdev_ioctl_data_unref(target);
  drop(*done);
  blocks_.erase(done);
  return {0, 0};
}

UsbfsFalcon::Answer UsbfsFalcon::discard(UMockdevIoctlClient* client) {
  gulong address = 0;
  std::memcpy(&address, umockdev_ioctl_client_get_arg(client)->data, sizeof address);
  for (Block& block : blocks_) {
    if (block.client != client || block.urb->client_addr != address || block.is_done) continue;
    finish(block, -ENOENT, 0);
    return {0, 0};
  }
  return {-1, EINVAL};
}

UsbfsFalcon::Answer UsbfsFalcon::clear_halt(UMockdevIoctlClient* client) {
  UMockdevIoctlData* endpoint =
      umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, sizeof(unsigned), nullptr);
  const bool is_in = endpoint->data[0] == kInEndpoint;
  umockdev_ioctl_data_unref(endpoint);
  const bool is_queued =
      std::any_of(blocks_.begin(), blocks_.end(), [&](const Block& b) { return b.is_receipt == is_in && !b.is_done; });
  if (is_queued) return {-1, EBUSY};
  (is_in ? in_is_halted_ : out_is_halted_) = false;
  ++cleared_halts_;
  return {0, 0};
}

void UsbfsFalcon::finish(Block& block, int status, int actual_length) {
  fields_of(block.urb).status = status;
  fields_of(block.urb).actual_length = actual_length;
  block.is_done = true;
}

void UsbfsFalcon::drop(Block& block) {
  umockdev_ioctl_data_unref(block.buffer);
  umockdev_ioctl_data_unref(block.urb);
}

}  // namespace myotact::device::falcon
