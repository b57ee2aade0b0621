#include "gui/input.h"

#include "gui/imgui_versions.h"

namespace talus::gui {

void InputQueue::forward_events(ImGuiIO& io) {
  bool pressed =
      false;  // after a button or key has changed, only its own character may follow in this picture
  while (!events_.empty()) {
    const InputEvent& event = events_.front();
    if (pressed && event.kind != InputEvent::Kind::character) break;
    pressed = pressed || event.kind == InputEvent::Kind::button || event.kind == InputEvent::Kind::key;
    forward_event(io, event);
    events_.pop_front();
  }
}

}  // namespace talus::gui
