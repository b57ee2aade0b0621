# Writes OUTPUT, a C++ source that defines talus::embedded::NAME with the bytes of INPUT.
file(READ ${INPUT} hex HEX)
string(REGEX REPLACE "(................................................)" "\\1\n" hex "${hex}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
file(WRITE ${OUTPUT} "#include <span>

namespace talus::embedded {
namespace {
const unsigned char bytes[] = {
${bytes}};
}
extern const std::span<const unsigned char> ${NAME};
const std::span<const unsigned char> ${NAME}(bytes, sizeof bytes);
}  // namespace talus::embedded
")
