#pragma once

#include <string>

#include "view/panels/panel.h"

namespace myotact::view {

/// The devices on the table: how far each one is, what the person is to do, how warm its motors are; stop and enable
/// the forces; the clutch.
void draw_devices(PanelContext& context);

/// A clutch is held: here or on a device.
bool is_clutched(const PanelContext& context);

/// Cannot be felt with until the person does something.
bool wants_a_person(const messages::DeviceReport& report);

/// "closed", "opening", "needs_calibration", "ready", "lost"; its text is devices.NAME.
const char* phase_name(messages::DevicePhase phase);

/// Which device, how far it is and what the person is to do, as one text.
std::string sentence_about(const DeviceNews& device);

}  // namespace myotact::view
