/// Prose in plain English: idioms that read translated are banned from code, texts and documentation.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include "unit/house/source_tree.h"

namespace talus::house {
namespace {

/// A banned idiom. In its words, `#` stands for a digit; `|` at its end bans it only before punctuation or
/// the end of a line.
struct Idiom {
  std::string_view words;
  std::string_view reason;
};

constexpr Idiom idioms[] = {
    {"anew", "archaic: again, or name what is recomputed"},
    {"beside", "spatial only: next to, alongside, in addition to, compared with"},
    {"told", "a program reports, shows or states; it does not tell"},
    {"tell", "a program reports, shows or states; it does not tell"},
    {"tells", "a program reports, shows or states; it does not tell"},
    {"telling", "a program reports, shows or states; it does not tell"},
    {"in all|", "in total, altogether"},
    {"so many", "give the number, or: this many"},
    {"any more", "no longer"},
    {"anymore", "no longer"},
    {"of now", "current, present"},
    {"at hand", "available"},
    {"that there is", "name the thing itself"},
    {"that there are", "name the things themselves"},
    {"all that", "everything that, or: all X that"},
    {"go on", "continue, resume"},
    {"goes on", "continues, resumes"},
    {"going on", "continuing, in progress"},
    {"gone on", "continued, resumed"},
    {"went on", "continued, resumed"},
    {"where there is", "a condition takes if or when"},
    {"where there are", "a condition takes if or when"},
    {"where there was", "a condition takes if or when"},
    {"where none", "a condition takes if or when"},
    {"where no", "a condition takes if or when"},
    {"where nothing", "a condition takes if or when"},
    {"where neither", "a condition takes if or when"},
    {"some #", "about"},
    {"stand in", "is in, appears in"},
    {"stands in", "is in, appears in"},
    {"learnt", "a program estimates or remembers"},
    {"guest", "say which load or process"},
    {"guests", "say which load or processes"},
    {"taken for", "considered, mistaken for"},
    {"take for", "consider, mistake for"},
    {"takes for", "considers, mistakes for"},
    {"what is there", "what exists; the existing X"},
    {"what was there", "what existed; the existing X"},
    {"of its own accord", "by itself"},
    {"round and round", "in a cycle"},
    {"at the most", "at most"},
    {"at the least", "at least"},
    {"no more than", "only, at most"},
    {"whole of", "all of, the entire X"},
    {"the one of", "that of"},
    {"the ones of", "those of"},
    {"once for all", "once"},
    {"once and for all", "once"},
    {"make again", "recreate, recompute"},
    {"makes again", "recreates, recomputes"},
    {"made again", "recreated, recomputed"},
};

/// Words with which no doc comment may begin: it begins with the noun or the verb that it is about.
constexpr std::string_view openings[] = {"what", "of", "with", "by", "where", "that",  "from",
                                         "on",   "at", "in",   "to", "as",    "among", "out"};

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

int is_part_of_word(int c) { return c == '_' ? 1 : std::isalnum(c); }

/// Whether a line in lower case holds the idiom, between other words.
bool holds(const std::string& line, const Idiom& idiom) {
  std::string words(idiom.words);
  if (std::isalpha(static_cast<unsigned char>(words.back())) != 0) return has_word(line, words);
  const bool ends = words.back() == '|';
  words.pop_back();
  for (auto at = line.find(words); at != std::string::npos; at = line.find(words, at + 1)) {
    const std::string_view after = std::string_view(line).substr(at + words.size());
    const bool begins = at == 0 || std::isalnum(static_cast<unsigned char>(line[at - 1])) == 0;
    const auto is = [&](std::size_t k, int (*kind)(int)) {
      return k < after.size() && kind(static_cast<unsigned char>(after[k])) != 0;
    };
    const bool goes_with =
        ends ? !is(0, is_part_of_word) && !(is(0, std::isspace) && is(1, std::isalpha)) : is(0, std::isdigit);
    if (begins && goes_with) return true;
  }
  return false;
}

/// The first word of a doc comment that begins on this line; empty if none does.
std::string_view opening_of(std::string_view line, std::string_view before) {
  const auto first = line.find_first_not_of(' ');
  auto at = line.find("///");
  if (at == std::string_view::npos) return {};
  const bool trailing = line.substr(at).starts_with("///<");
  const auto previous = before.find_first_not_of(' ');
  const bool continues =
      at == first && !trailing &&
      ((previous != std::string_view::npos && before.substr(previous).starts_with("///")) ||
       before.find("///<") != std::string_view::npos);
  if (continues) return {};
  at = line.find_first_not_of(" .", at + (trailing ? 4 : 3));
  if (at == std::string_view::npos) return {};
  const auto end = line.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ", at);
  return line.substr(at, end == std::string_view::npos ? end : end - at);
}

/// Files whose prose is ours and not quoted.
std::vector<TextFile> prose() {
  auto texts = read_texts({".", ".ci", "src", "render", "shaders", "tests", "assets", "bench", "docs",
                           "cmake", "python", "examples"});
  std::erase_if(texts, [](const TextFile& file) {
    return file.path.ends_with("idioms_test.cpp") || file.path == "LICENSE" || file.path.ends_with(".bib") ||
           file.path.ends_with(".csv");
  });
  return texts;
}

TEST(Idioms, are_banned_from_prose) {
  const auto texts = prose();
  EXPECT_GT(texts.size(), 500u) << "the files were not found";
  for (const TextFile& file : texts)
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      const std::string line = lower_case(file.lines[i]);
      for (const Idiom& idiom : idioms)
        if (holds(line, idiom))
          ADD_FAILURE() << place(file, i) << ": \"" << idiom.words << "\": " << idiom.reason;
    }
}

TEST(Idioms, doc_comments_begin_with_their_subject_or_verb) {
  for (const TextFile& file : prose())
    for (std::size_t i = 0; is_source(file) && i < file.lines.size(); ++i) {
      const std::string word =
          lower_case(opening_of(file.lines[i], i > 0 ? file.lines[i - 1] : std::string_view()));
      if (std::ranges::count(openings, word) > 0)
        ADD_FAILURE() << place(file, i) << ": a doc comment opens with \"" << word << "\"";
    }
}

TEST(Idioms, are_recognised) {
  EXPECT_TRUE(holds("it is computed anew.", {"anew", ""}));
  EXPECT_FALSE(holds("the renewal", {"anew", ""}));
  EXPECT_TRUE(holds("ten in all, and", {"in all|", ""}));
  EXPECT_TRUE(holds("ten in all", {"in all|", ""}));
  EXPECT_FALSE(holds("in all members", {"in all|", ""}));
  EXPECT_TRUE(holds("some 20 beds", {"some #", ""}));
  EXPECT_FALSE(holds("some beds", {"some #", ""}));
  EXPECT_EQ(opening_of("/// What it is.", ""), "What");
  EXPECT_EQ(opening_of("/// of it.", "/// the mean"), "");
  EXPECT_EQ(opening_of("  double x;  ///< of the bed", ""), "of");
  EXPECT_EQ(opening_of("  double x;", ""), "");
}

}  // namespace
}  // namespace talus::house
