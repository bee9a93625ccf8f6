#include "device/drivers/inverse/greeting.h"

#include <chrono>

#include <fmt/format.h>

namespace myotact::device::inverse {

namespace {

constexpr std::chrono::seconds kInventoryWait(1);

CommandForm form_of(ServiceLink& link, const ServiceMessage& inventory, const InverseSettings& settings) {
  if (settings.form != CommandForm::ByVersion) return settings.form;
  const auto version = read_version(inventory.version);
  return form_for(version ? version : read_version(link.ask_version()));
}

}  // namespace

Greeting greet(ServiceLink& link, const InverseSettings& settings) {
  link.connect();
  const auto stranger = [&](const std::string& why) {
    return ServiceError(fmt::format("what listens on {}:{} does not talk as the Inverse Service does: {}",
                                    settings.address, settings.port, why),
                        "stop that program, or give the service's port, and see that the service is version 3");
  };
  std::string text;
  if (link.receive(text, kInventoryWait) != LinkEvent::Message) throw stranger("it sends no inventory");
  Greeting greeting;
  const std::string problem = read_message(text, greeting.inventory);
  if (!problem.empty()) throw stranger(problem);
  greeting.form = form_of(link, greeting.inventory, settings);
  return greeting;
}

}  // namespace myotact::device::inverse
