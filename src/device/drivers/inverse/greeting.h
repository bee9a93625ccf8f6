#pragma once

#include "device/drivers/inverse/messages.h"
#include "device/drivers/inverse/service_link.h"
#include "device/drivers/inverse/settings.h"

namespace myotact::device::inverse {

/// What a service sends first.
struct Greeting {
  ServiceMessage inventory;
  CommandForm form = CommandForm::Vector;  // what it wants, or what the settings say
};

/// Connects and waits for the inventory. Throws ServiceError.
Greeting greet(ServiceLink& link, const InverseSettings& settings);

}  // namespace myotact::device::inverse
