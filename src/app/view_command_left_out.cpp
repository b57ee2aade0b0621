/// `talus view` in a build without the window.

#include "app/commands.h"
#include "base/errors.h"

namespace talus::app {

const bool has_window = false;

void add_view_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("view", "Show a run in a window (not included in this build)");
  command->allow_extras();
  command->callback([] {
    throw Error(ExitCode::unavailable,
                "this talus was built without its window; apt-get install libimgui-dev libglfw3-dev, then "
                "configure it with -DTALUS_GUI=ON and build it again");
  });
}

}  // namespace talus::app
