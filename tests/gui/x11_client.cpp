#include "gui/x11_client.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <thread>

namespace talus::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr long protocol_version = 5;
constexpr long inside = 20;  // px of the window, position of the drop

class Client {
 public:
  explicit Client(const std::string& target)
      : display_(XOpenDisplay(nullptr), XCloseDisplay), target_(std::stoul(target)) {
    if (display_)
      own_ = XCreateSimpleWindow(display_.get(), DefaultRootWindow(display_.get()), 0, 0, 1, 1, 0, 0, 0);
  }

  bool connected() const { return display_ != nullptr; }
  Display* display() const { return display_.get(); }
  Window own() const { return own_; }
  Window target() const { return target_; }
  Atom atom(const char* name) const { return XInternAtom(display_.get(), name, False); }

  void send(const char* type, const std::array<long, 5>& data) const {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = target_;
    event.xclient.message_type = atom(type);
    event.xclient.format = 32;
    for (std::size_t k = 0; k < data.size(); ++k) event.xclient.data.l[k] = data[k];
    XSendEvent(display_.get(), target_, False, NoEventMask, &event);
    XFlush(display_.get());
  }

  /// Returns the next event; nothing after five seconds.
  std::optional<XEvent> next() const {
    for (const auto end = Clock::now() + std::chrono::seconds(5); Clock::now() < end;) {
      if (XPending(display_.get()) > 0) {
        XEvent event;
        XNextEvent(display_.get(), &event);
        return event;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return std::nullopt;
  }

 private:
  std::unique_ptr<Display, int (*)(Display*)> display_;
  Window target_ = 0, own_ = 0;
};

/// Sends the file's name to the requesting client.
void answer(const Client& client, const XSelectionRequestEvent& request, const std::string& uri) {
  XChangeProperty(client.display(), request.requestor, request.property, request.target, 8, PropModeReplace,
                  reinterpret_cast<const unsigned char*>(uri.data()), static_cast<int>(uri.size()));
  XEvent event{};
  event.xselection.type = SelectionNotify;
  event.xselection.requestor = request.requestor;
  event.xselection.selection = request.selection;
  event.xselection.target = request.target;
  event.xselection.property = request.property;
  event.xselection.time = request.time;
  XSendEvent(client.display(), request.requestor, False, NoEventMask, &event);
  XFlush(client.display());
}

}  // namespace

bool drop_file(const std::string& window, const std::string& path) {
  const Client client(window);
  if (!client.connected()) return false;
  const long own = static_cast<long>(client.own()), list = static_cast<long>(client.atom("text/uri-list"));
  const long copy = static_cast<long>(client.atom("XdndActionCopy"));
  XSetSelectionOwner(client.display(), client.atom("XdndSelection"), client.own(), CurrentTime);
  client.send("XdndEnter", {own, protocol_version << 24, list, 0, 0});
  client.send("XdndPosition", {own, 0, (inside << 16) | inside, CurrentTime, copy});
  while (const std::optional<XEvent> event = client.next()) {
    if (event->type == SelectionRequest) answer(client, event->xselectionrequest, "file://" + path + "\r\n");
    if (event->type != ClientMessage) continue;
    if (event->xclient.message_type == client.atom("XdndFinished")) return true;
    const bool status = event->xclient.message_type == client.atom("XdndStatus");
    if (status && (event->xclient.data.l[1] & 1) == 0) return false;
    if (status) client.send("XdndDrop", {own, 0, CurrentTime, 0, 0});
  }
  return false;
}

void ask_to_close(const std::string& window) {
  const Client client(window);
  if (!client.connected()) return;
  client.send("WM_PROTOCOLS", {static_cast<long>(client.atom("WM_DELETE_WINDOW")), CurrentTime, 0, 0, 0});
}

}  // namespace talus::test
