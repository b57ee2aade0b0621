#include "base/text_stream.h"

#include <gtest/gtest.h>

#include <new>

namespace talus {
namespace {

TEST(TextStream, reads_what_the_text_has) {
  std::istringstream stream = text_stream("a b\nc");
  std::string line, end;
  std::getline(stream, line);
  EXPECT_EQ(line, "a b");
  EXPECT_TRUE(stream >> line);
  EXPECT_EQ(line, "c");
  EXPECT_FALSE(stream >> end) << "the end of the text is not an error";
}

/// Buffer in which every read fails for lack of memory.
class NoMemory : public std::stringbuf {
  int_type underflow() override { throw std::bad_alloc(); }
};

TEST(TextStream, throws_where_memory_is_missing) {
  NoMemory buffer;
  std::istringstream stream = text_stream("");
  stream.std::ios::rdbuf(&buffer);
  stream.exceptions(text_stream("").exceptions());
  std::string line;
  EXPECT_THROW(std::getline(stream, line), std::bad_alloc);
  std::istringstream plain;
  plain.std::ios::rdbuf(&buffer);
  EXPECT_NO_THROW(std::getline(plain, line)) << "the reason";
}

}  // namespace
}  // namespace talus
