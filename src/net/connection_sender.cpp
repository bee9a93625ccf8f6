#include <exception>
#include <mutex>
#include <vector>

#include <spdlog/spdlog.h>

#include "net/connection.h"
#include "net/local_model_codec.h"
#include "realtime/periodic_loop.h"
#include "realtime/real_time_thread.h"

// The thread of a connection that sends what is new, and the one place where bytes leave.

namespace myotact::net {

void Connection::send_all() {
  realtime::name_this_thread("net send");
  constexpr std::chrono::milliseconds kLook(100);
  std::uint64_t heard = 0;
  try {
    while (!closing_) {
      heard = server_.bell.wait(heard, kLook);
      if (closing_ || dismissed_ || (send_news() && !is_stuck_) || closing_ || dismissed_) continue;
      server_.count(&ServerCounters::closed_slow);
      complain("it takes nothing of what is sent to it");
      break;
    }
  } catch (const std::exception& failure) {
    server_.count(&ServerCounters::failed);
    complain(failure.what());
  }
  closing_ = true;
  shut_down();
}

bool Connection::send_news() {
  return send_events() && send_announcement() && send_model() && send_scene() && send_picture();
}

bool Connection::send_events() {
  if (const std::uint32_t now = server_.stops; now != stops_) {
    stops_ = now;
    if (!write(encode(Event{EventCode::Stop, 0, "somebody stopped all forces"}))) return false;
  }
  std::deque<Event> refusals;
  {
    const std::lock_guard lock(refusing_);
    refusals.swap(refusals_);
  }
  for (const Event& refusal : refusals) {
    if (!write(encode(refusal))) return false;
  }
  return true;
}

bool Connection::send_announcement() {
  if (!wants_.announcements) return true;
  const std::shared_ptr<const Announcement> said = server_.announcement();
  if (!said || said == heard_) return true;
  heard_ = said;
  const std::string& text = role_ == Role::Instructor ? said->to_instructors : said->to_all;
  return write(FrameType::Control, 0, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

bool Connection::send_model() {
  if (hand_ < 0 || wants_.pictures) return true;
  HandChannels& channels = server_.hands.channels(hand_);
  if (!channels.models.update()) return true;
  encode(channels.models.front(), model_bytes_);
  return write(FrameType::LocalModel, 0, model_bytes_);
}

bool Connection::send_scene() {
  if (!wants_.frames || wants_.pictures) return true;
  const std::shared_ptr<const EncodedScene> scene = server_.scene();
  if (!scene || scene == shown_) return true;
  const std::vector<const EncodedFrame*> frames = frames_to_send(*scene, shown_.get(), wants_);
  for (const EncodedFrame* frame : frames) {
    const std::uint8_t flags = frame == frames.back() ? kLastOfScene : 0;
    // What a hand waits for goes between: a scene's frames may take a slow line long.
    if (!send_events() || !send_model() || !write(frame->type, flags, frame->payload)) return false;
  }
  shown_ = scene;
  return true;
}

/// No more is under way than a slow line carries in a second: what waits in buffers is old when it arrives.
bool Connection::send_picture() {
  constexpr std::size_t kMostUnseen = 24 * 1024;  // bytes; at 4 kB a picture and 30 a second, a round trip of 200 ms
  if (!wants_.pictures) return true;
  const std::shared_ptr<const ScenePicture> picture = server_.picture();
  if (!picture || picture == pictured_) return true;
  while (!unseen_.empty() && unseen_.front().first <= seen_) unseen_.pop_front();
  std::size_t unseen_bytes = 0;
  for (const auto& [sequence, bytes] : unseen_) unseen_bytes += bytes;
  if (unseen_bytes >= kMostUnseen) return true;
  const Bytes payload = picture_payload(*picture, pictured_.get());
  if (!write(FrameType::Picture, 0, payload)) return false;
  unseen_.emplace_back(picture->sequence, payload.size());
  pictured_ = picture;
  return true;
}

bool Connection::write(const SmallFrame& frame, bool may_drop) {
  return write(frame.type, frame.flags, frame.payload(), may_drop);
}

/// Either thread. False: not sent.
bool Connection::write(FrameType type, std::uint8_t flags, std::span<const std::uint8_t> payload, bool may_drop) {
  const std::lock_guard lock(writing_);
  return write_locked(type, flags, payload, may_drop);
}

void Connection::dismiss(ByeReason reason, const std::string& why) {
  if (closing_ || dismissed_) return;
  const std::unique_lock lock(writing_, std::try_to_lock);  // who is still taking a frame has no ear for it
  const SmallFrame bye = encode(Bye{reason, why});
  if (lock) write_locked(bye.type, bye.flags, bye.payload(), true);
  dismissed_ = true;
}

bool Connection::write_locked(FrameType type, std::uint8_t flags, std::span<const std::uint8_t> payload,
                              bool may_drop) {
  if (is_stuck_ || dismissed_) return false;
  FrameHeader header;
  header.type = type;
  header.flags = flags;
  header.sequence = sequence_;
  header.time_ns = realtime::steady_now_ns();
  const Sent sent = send(socket_, header_bytes(header, payload), payload, may_drop, server_.settings.slow_wait);
  if (sent == Sent::All) ++sequence_;
  if (sent == Sent::Failed) is_stuck_ = true;  // it may have half of a frame
  return sent == Sent::All;
}

}  // namespace myotact::net
