#include "view/sound/speaker.h"

#include <array>
#include <atomic>
#include <chrono>
#include <stop_token>
#include <string>
#include <thread>

#include <alsa/asoundlib.h>

#include "core/error.h"
#include "view/sound/force_tone.h"

namespace myotact::view {

namespace {

constexpr int kPeriod_ms = 10;
constexpr int kSilentAfter_ms = 250;
constexpr unsigned kLatency_us = 50'000;  // of ALSA's buffer
constexpr int kWait_ms = 100;             // for room in it, at most: then a request to stop is seen
constexpr double kNothingNew = -1.0;

using Period = std::array<std::int16_t, kSoundRate_Hz / 1000 * kPeriod_ms>;

void say_nothing(const char*, int, const char*, int, const char*, ...) {}  // the caller reports what failed

void require(int answer, const std::string& what) {
  if (answer >= 0) return;
  throw Error(ExitStatus::Unavailable, what + ": " + snd_strerror(answer));
}

struct CloseOutput {
  void operator()(snd_pcm_t* output) const { snd_pcm_close(output); }
};
using Output = std::unique_ptr<snd_pcm_t, CloseOutput>;

Output open_output() {
  snd_lib_error_set_handler(say_nothing);
  snd_pcm_t* opened = nullptr;
  require(snd_pcm_open(&opened, "default", SND_PCM_STREAM_PLAYBACK, SND_PCM_NONBLOCK), "the sound output");
  Output output(opened);
  constexpr unsigned kChannels = 1;
  constexpr int kMayResample = 1;
  require(snd_pcm_set_params(opened, SND_PCM_FORMAT_S16, SND_PCM_ACCESS_RW_INTERLEAVED, kChannels, kSoundRate_Hz,
                             kMayResample, kLatency_us),
          "the sound output takes no plain samples");
  return output;
}

/// All of it, unless a stop is requested. False: the output is gone.
bool write_all(snd_pcm_t* output, const Period& period, const std::stop_token& stop) {
  std::size_t done = 0;
  while (done < period.size() && !stop.stop_requested()) {
    int answer = snd_pcm_wait(output, kWait_ms);
    if (answer == 0) continue;
    snd_pcm_sframes_t written = answer;
    if (answer > 0) written = snd_pcm_writei(output, period.data() + done, period.size() - done);
    if (written == -EAGAIN) continue;
    if (written < 0 && snd_pcm_recover(output, static_cast<int>(written), 1) < 0) return false;
    if (written > 0) done += static_cast<std::size_t>(written);
  }
  return true;
}

}  // namespace

struct Speaker::Impl {
  void run(const std::stop_token& stop) {
    ForceTone tone;
    Period period;
    for (int silent_ms = 0; !stop.stop_requested(); silent_ms += kPeriod_ms) {
      // An output that takes everything at once, as ALSA's "null", must not become a busy loop.
      const auto earliest = std::chrono::steady_clock::now() + std::chrono::milliseconds(kPeriod_ms * 9 / 10);
      if (const double share = share_.exchange(kNothingNew); share != kNothingNew) {
        tone.aim(share);
        silent_ms = 0;
      } else if (silent_ms >= kSilentAfter_ms) {
        tone.aim(0.0);
      }
      tone.fill(period);
      if (!write_all(output.get(), period, stop)) return;
      std::this_thread::sleep_until(earliest);
    }
  }

  Output output = open_output();
  std::atomic<double> share_ = kNothingNew;
  std::jthread thread{[this](const std::stop_token& stop) { run(stop); }};  // last: it uses the others
};

Speaker::Speaker() : impl_(std::make_unique<Impl>()) {}

Speaker::~Speaker() = default;

void Speaker::play(double share) {
  impl_->share_.store(share);
}

}  // namespace myotact::view
