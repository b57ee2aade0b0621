# Writes OUTPUT, a C++ source that defines talus::embedded::NAME with the bytes of FILE for each line "NAME=FILE" of LIST.
file(STRINGS ${LIST} entries)
file(WRITE ${OUTPUT} "#include <span>\n\nnamespace talus::embedded {\n")
foreach(entry ${entries})
  string(REGEX MATCH "^([^=]+)=(.*)$" whole "${entry}")
  set(name ${CMAKE_MATCH_1})
  file(READ ${CMAKE_MATCH_2} hex HEX)
  string(REGEX REPLACE "(................................................)" "\\1\n" hex "${hex}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  file(APPEND ${OUTPUT} "
static const unsigned char ${name}_bytes[] = {
${bytes}};
extern const std::span<const unsigned char> ${name};
const std::span<const unsigned char> ${name}(${name}_bytes, sizeof ${name}_bytes);
")
endforeach()
file(APPEND ${OUTPUT} "\n}  // namespace talus::embedded\n")
