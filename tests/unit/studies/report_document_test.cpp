/// Report as a single HTML page.

#include "studies/report_document.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/errors.h"
#include "support/temporary_folder.h"

namespace talus::studies {
namespace {

ReportDocument small_report() {
  return {
      "Title & more",
      {ReportHeading{2, "Part"}, ReportParagraph{"a < b with `x_1 < y`"}, ReportList{{"one", "two_2"}},
       ReportCommands{{"talus run a.toml"}},
       TextTable{{{"name"}, {"value", true}},
                 {{{"p_o | all"}, {"0.3", "agrees", Tone::good}}, {{""}, {"", "not run", Tone::muted}}}}}};
}

TEST(Html, escapes_everything_and_marks_cells) {
  const std::string page = report_html(small_report(), ".");
  for (const char* part :
       {"<title>Title &amp; more</title>", "<h2 id=\"part\">Part</h2>",
        "<p>a &lt; b with <code>x_1 &lt; y</code></p>", "<li>two_2</li>", "<pre>talus run a.toml\n</pre>",
        "<th class=\"number\">value</th>", "<td>p_o | all</td>",
        "<td class=\"number good\">0.3<span class=\"note\">agrees</span></td>",
        "<td class=\"number muted\"><span class=\"note\">not run</span></td>"})
    EXPECT_NE(page.find(part), std::string::npos) << part << "\n" << page;
}

TEST(Html, contents_link_to_each_heading_of_the_second_level) {
  const std::string page = report_html({"t",
                                        {ReportContents{}, ReportHeading{2, "What was run?"},
                                         ReportHeading{3, "Not in it"}, ReportHeading{2, "l_c & theta_d"}}},
                                       ".");
  EXPECT_NE(page.find("<nav><ol>\n<li><a href=\"#what-was-run-\">What was run?</a></li>\n"
                      "<li><a href=\"#l-c-theta-d\">l_c &amp; theta_d</a></li>\n</ol></nav>"),
            std::string::npos)
      << page;
  for (const char* heading :
       {"<h2 id=\"what-was-run-\">", "<h2 id=\"l-c-theta-d\">", "<h3 id=\"not-in-it\">"})
    EXPECT_NE(page.find(heading), std::string::npos) << heading;
}

class HtmlPicture : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(HtmlPicture, is_built_in) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path("p.png"), std::ios::binary) << GetParam().first;
  const ReportDocument document{"t", {ReportPicture{"p.png", "A \"picture\"", "Shows it.", true}}};
  const std::string page = report_html(document, folder.path().string());
  EXPECT_NE(page.find("<figure class=\"wide\"><img alt=\"A &quot;picture&quot;\" "
                      "src=\"data:image/png;base64," +
                      std::string(GetParam().second) + "\">"),
            std::string::npos)
      << page;
  EXPECT_EQ(page.find("p.png"), std::string::npos) << "the page needs no other files";
}

// Test vectors of RFC 4648, and bytes with the highest bit set.
INSTANTIATE_TEST_SUITE_P(Base64, HtmlPicture,
                         testing::Values(std::pair("f", "Zg=="), std::pair("fo", "Zm8="),
                                         std::pair("foo", "Zm9v"), std::pair("foobar", "Zm9vYmFy"),
                                         std::pair("\xff\xfe\xfb", "//77")));

TEST(Html, without_its_picture_is_an_error) {
  EXPECT_THROW(report_html({"t", {ReportPicture{"none.png", "", ""}}}, "."), Error);
}

}  // namespace
}  // namespace talus::studies
