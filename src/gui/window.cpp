/// Window of `talus view`.

// The renderer has its own OpenGL header.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cfloat>
#include <cstdlib>
#include <filesystem>
#include <fmt/core.h>
#include <string_view>
#include <utility>

#include "base/errors.h"
#include "base/text.h"
#include "gui/screen.h"

namespace talus::gui {
namespace {

constexpr double picture_time = 1.0 / 60.0;  ///< s, minimum time per picture
constexpr int smallest_side = 200;           ///< minimum side of the window, px
constexpr float nowhere = -FLT_MAX;          ///< ImGui's value for a mouse outside the window
constexpr double longest_wait = 0.1;         ///< s, until the model is polled again
/// Pictures drawn after the last change: ImGui knows the mouse one picture later, and hints fade in.
constexpr int settling_pictures = 4;
constexpr double fast_after_change = 0.5;  ///< s after a change during which the model is polled often
constexpr double shortest_wait = 0.003;    ///< s between two polls, because the solver needs the core too
constexpr double blink_time = 0.25;        ///< s, blinking of the cursor in a text field

/// OpenGL context of a window, made current.
class WindowContext final : public render::Context {
 public:
  Function function(const char* name) const override { return glfwGetProcAddress(name); }
};

constexpr const char* without_display =
    "talus view --screenshot, talus render and talus export --to html draw without one";

/// Initialises GLFW, and terminates it at the end of its life.
class Glfw {
 public:
  Glfw() {
#ifdef GLFW_PLATFORM  // since 3.4: without a display of Wayland its library would write to the terminal
    if (std::getenv("WAYLAND_DISPLAY") == nullptr) glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
    if (glfwInit()) return;
    const char* reason = nullptr;
    glfwGetError(&reason);
    throw Error(ExitCode::unavailable,
                fmt::format("no window: {}; talus view needs a display; {}",
                            reason ? reason : "GLFW cannot be initialised", without_display));
  }
  ~Glfw() { glfwTerminate(); }
  Glfw(const Glfw&) = delete;
  Glfw& operator=(const Glfw&) = delete;
};

using WindowHandle = std::unique_ptr<GLFWwindow, void (*)(GLFWwindow*)>;

/// Returns what to do if no window has OpenGL, for the reason that GLFW gives.
std::string opengl_advice(std::string_view reason) {
  // GLFW: "GLX: GLX extension not found"
  const bool display_lacks_it = reason.find("extension not found") != std::string_view::npos;
  if (const std::string variables = render::driver_variables(); !display_lacks_it && !variables.empty())
    return "the environment configures its driver, try without " + visible_word(variables, 200);
  // GLFW: "GLX: Failed to load GLX", "EGL: Library not found"
  if (reason.find("Failed to load") != std::string_view::npos ||
      reason.find("Library not found") != std::string_view::npos)
    return "apt-get install libgl1 libgl1-mesa-dri";
  const char* const display = std::getenv("DISPLAY");
  return fmt::format(
      "the display {} does not offer it, as is common over ssh -X and VNC, and no package mends that: use a "
      "display of this machine; {}",
      visible_word(display ? display : "", 200), without_display);
}

WindowHandle make_window(int width, int height) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  WindowHandle window(glfwCreateWindow(width, height, "Talus", nullptr, nullptr), glfwDestroyWindow);
  if (!window) {
    const char* reason = nullptr;
    glfwGetError(&reason);
    if (reason == nullptr) reason = "unknown";
    throw Error(ExitCode::unavailable,
                fmt::format("no window with OpenGL 3.3: {}; {}", reason, opengl_advice(reason)));
  }
  glfwMakeContextCurrent(window.get());
  glfwSwapInterval(1);
  return window;
}

/// Shrinks a window that is too large for its display. A window manager would do this, but there may be none.
void fit_display(GLFWwindow* window) {
  GLFWmonitor* const display = glfwGetPrimaryMonitor();
  if (display == nullptr) return;
  int left = 0, top = 0, max_width = 0, max_height = 0, width = 0, height = 0;
  glfwGetMonitorWorkarea(display, &left, &top, &max_width, &max_height);
  if (max_width <= 0 || max_height <= 0) return;
  glfwGetWindowSize(window, &width, &height);
  if (width <= max_width && height <= max_height) return;
  glfwSetWindowSize(window, std::min(width, max_width), std::min(height, max_height));
  glfwSetWindowPos(window, left, top);
}

/// Returns the enlargement of text and widgets for the display. If a window has more pixels than its size
/// states, they make the picture sharper, not larger.
float display_scale(GLFWwindow* window) {
  float scale = 1.0f;
  int width = 1, pixels = 1, height = 0;
  glfwGetWindowContentScale(window, &scale, nullptr);
  glfwGetWindowSize(window, &width, &height);
  glfwGetFramebufferSize(window, &pixels, &height);
  return std::clamp(scale * static_cast<float>(width) / static_cast<float>(std::max(pixels, 1)), 0.5f, 4.0f);
}

}  // namespace

struct WindowState {
  WindowState(int width, int height)
      : window(make_window(width, height)),
        screen(std::make_unique<WindowContext>(), display_scale(window.get())) {}

  Glfw glfw;
  WindowHandle window;
  GuiScreen screen;
  std::string title;
  std::string dropped;         ///< path of a dropped file
  int pictures_due = 1;        ///< pictures to draw even if the model does not change
  double last_picture = -1.0;  ///< s, clock of GLFW
  double last_update = -1.0, last_change = -1.0;
};

namespace {

WindowState& state_of(GLFWwindow* window) {
  return *static_cast<WindowState*>(glfwGetWindowUserPointer(window));
}

void add(GLFWwindow* window, const InputEvent& event) {
  state_of(window).screen.input().add(event);
  state_of(window).pictures_due = settling_pictures;
}

void catch_input(GLFWwindow* window) {
  using Kind = InputEvent::Kind;
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    add(w, {Kind::position, static_cast<float>(x), static_cast<float>(y), 0, false});
  });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int entered) {
    if (!entered) add(w, {Kind::position, nowhere, nowhere, 0, false});
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
    add(w, {Kind::button, 0.0f, 0.0f, button, action == GLFW_PRESS});
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
    add(w, {Kind::wheel, static_cast<float>(x), static_cast<float>(y), 0, false});
  });
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
    if (action != GLFW_REPEAT)
      add(w, {Kind::key, 0.0f, 0.0f, key, action == GLFW_PRESS});  // ImGui generates its own key repeats
  });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned character) {
    add(w, {Kind::character, 0.0f, 0.0f, static_cast<int>(character), false});
  });
}

void catch_window_events(GLFWwindow* window) {
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
    state_of(w).screen.io().AddFocusEvent(focused != 0);  // losing the focus releases all keys
    state_of(w).pictures_due = settling_pictures;
  });
  glfwSetFramebufferSizeCallback(
      window, [](GLFWwindow* w, int, int) { state_of(w).pictures_due = settling_pictures; });
  glfwSetWindowContentScaleCallback(window, [](GLFWwindow* w, float, float) {
    state_of(w).screen.set_display_scale(display_scale(w));  // the window is on another display
    state_of(w).pictures_due = settling_pictures;
  });
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { state_of(w).pictures_due = settling_pictures; });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    if (count > 0) state_of(w).dropped = paths[0];
  });
}

void lend_clipboard(WindowState& state) {
  ImGuiIO& io = state.screen.io();
  io.ClipboardUserData = state.window.get();
  io.SetClipboardTextFn = [](void* window, const char* text) {
    glfwSetClipboardString(static_cast<GLFWwindow*>(window), text);
  };
  io.GetClipboardTextFn = [](void* window) {
    return glfwGetClipboardString(static_cast<GLFWwindow*>(window));
  };
}

/// Waits for events, for possible news from the model, or for the next picture.
void wait(WindowState& state, const view::ViewModel& model) {
  const double now = glfwGetTime();
  const bool busy = state.pictures_due > 0 || state.screen.input().waiting() ||
                    (model.replay() && model.replay()->playing()) ||
                    now - state.last_change < fast_after_change;
  const double until_picture = state.last_picture + picture_time - now;
  const double at_least = state.pictures_due > 0 || state.screen.input().waiting() ? 0.0 : shortest_wait;
  const double seconds = busy ? std::max(until_picture, at_least) : longest_wait;
  if (seconds > 0.0)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
}

/// Advances the model, and notes whether a redraw is needed.
void update(WindowState& state, view::ViewModel& model) {
  const double now = glfwGetTime();
  const double seconds = state.last_update < 0.0 ? 0.0 : now - state.last_update;
  state.last_update = now;
  if (model.update(seconds)) {
    state.last_change = now;
    state.pictures_due = std::max(state.pictures_due, 1);
  }
  if (state.screen.input().waiting()) state.pictures_due = settling_pictures;
  if (state.screen.io().WantTextInput && now - state.last_picture > blink_time)
    state.pictures_due = std::max(state.pictures_due, 1);
}

/// Sets the title, such as "bed.h5, 12.25° – Talus".
void set_title(WindowState& state, const view::ViewModel& model) {
  const std::string file = std::filesystem::path(model.path()).filename().string();
  const std::string title = fmt::format("{}, {}° – Talus", file, degrees_text(model.frame().tilt, 2));
  if (title == state.title) return;
  state.title = title;
  glfwSetWindowTitle(state.window.get(), title.c_str());
}

void draw(WindowState& state, view::ViewModel& model, int width, int height, GuiRequests& requests) {
  const double now = glfwGetTime();
  Surface surface;
  glfwGetFramebufferSize(state.window.get(), &surface.width, &surface.height);
  const double seconds = state.last_picture < 0.0 ? picture_time : now - state.last_picture;
  state.last_picture = now;
  --state.pictures_due;
  state.screen.draw(model, surface, width, height, seconds, requests);
  glfwSwapBuffers(state.window.get());
}

}  // namespace

GuiWindow::GuiWindow(int width, int height) : state_(std::make_unique<WindowState>(width, height)) {
  GLFWwindow* window = state_->window.get();
  glfwSetWindowUserPointer(window, state_.get());
  fit_display(window);
  glfwSetWindowSizeLimits(window, smallest_side, smallest_side, GLFW_DONT_CARE, GLFW_DONT_CARE);
  catch_input(window);
  catch_window_events(window);
  lend_clipboard(*state_);
}

GuiWindow::~GuiWindow() = default;

GuiRequests GuiWindow::next_picture(view::ViewModel& model) {
  WindowState& state = *state_;
  GuiRequests requests;
  if (glfwWindowShouldClose(state.window.get())) {
    glfwSetWindowShouldClose(state.window.get(), GLFW_FALSE);
    requests.quit = model.may_discard();
    if (requests.quit) return requests;
  }
  if (state.last_picture < 0.0) glfwShowWindow(state.window.get());
  wait(state, model);
  update(state, model);
  int width = 0, height = 0;
  glfwGetWindowSize(state.window.get(), &width, &height);
  const bool visible = width > 0 && height > 0 && !glfwGetWindowAttrib(state.window.get(), GLFW_ICONIFIED);
  const bool due = state.pictures_due > 0 && glfwGetTime() - state.last_picture >= 0.9 * picture_time;
  if (visible && due) {
    draw(state, model, width, height, requests);
    set_title(state, model);
  }
  if (!state.dropped.empty()) requests.open_path = std::exchange(state.dropped, {});
  return requests;
}

GuiScreen& GuiWindow::screen() { return state_->screen; }

}  // namespace talus::gui
