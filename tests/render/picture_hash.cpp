/// Prints the hash of one picture, so that a test can compare processes with different settings.

#include <cstdio>

#include "core/hash.h"
#include "render/renderer.h"
#include "render/synthetic_bed.h"
#include "render/synthetic_view.h"

int main() {
  talus::Renderer renderer(talus::make_osmesa_context());
  const talus::Image image = renderer.draw(talus::test::synthetic_view(talus::MapKind::gamma), 800);
  std::printf("%s\n", talus::hash_text(talus::hash_bytes(std::as_bytes(std::span(image.gray)))).c_str());
}
