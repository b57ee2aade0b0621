/// Prints the hash of one picture, so that a test can compare processes with different settings: picture_hash
/// [auto|osmesa|egl]. Without a context it reports the reason and exits with the exit code of the error.

#include <cstdio>

#include "base/errors.h"
#include "base/hash.h"
#include "render/renderer.h"
#include "render/sample_view.h"

int main(int argc, char** argv) {
  try {
    talus::render::Renderer renderer(
        talus::render::make_context(talus::render::context_kind(argc > 1 ? argv[1] : "auto")));
    const talus::render::Image image = renderer.draw(talus::test::full_view(), 800);
    std::printf("%s\n", talus::hash_text(talus::hash_bytes(std::as_bytes(std::span(image.pixels)))).c_str());
    return 0;
  } catch (const talus::Error& error) {
    std::printf("%s\n", error.what());
    return static_cast<int>(error.code());
  }
}
