#pragma once

#include <fmt/format.h>
#include <rapidcheck.h>

#include <string>
#include <vector>

/// For tests: documents with everything that makes cutting hard, regenerated in every run of a property.
namespace signweave::testing_documents {

inline int pick(int below) {
  return *rc::gen::inRange(0, below);
}

/// Names that some documents use, and one that no document uses.
inline const std::vector<std::string>& tier_names() {
  static const std::vector<std::string> names = {"Gloss", "Phase", "A & B", "Übersetzung", "it's", "none"};
  return names;
}

inline std::string escaped_name(const std::string& name) {
  return name == "A & B" ? "A &amp; B" : name == "it's" ? "it&apos;s" : name;
}

inline std::string blank() {
  constexpr const char* kBlanks[] = {"", "\n", "\n    ", "\r\n\t", " <!-- <ANNOTATION> <el> --> ", "<?x </TIER> ?>"};
  return kBlanks[pick(6)];
}

inline std::string label() {
  constexpr const char* kLabels[] = {"",      "VANNES", " été ",        "&lt;TIER&gt;", "<![CDATA[</ANNOTATION> & ]]>",
                                     "MATIN", "12",     "a<!-- b -->c", "x &#233; y"};
  return kLabels[pick(9)];
}

/// An EAF file that its reader accepts. With `odd`, some have elements of the same names in other positions.
inline std::string eaf_text(bool odd) {
  std::string text = pick(4) == 0 ? "\xEF\xBB\xBF" : "";
  if (pick(2) == 0) text += "<?xml version=\"1.0\" encoding=\"UTF-8\"?>" + blank();
  text +=
      "<ANNOTATION_DOCUMENT FORMAT='3.0'\n xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" AUTHOR=\"a > b\">";
  text += "\n<TIME_ORDER>\n";
  const int slots = 2 + pick(12);
  for (int i = 0; i < slots; ++i) {
    text += fmt::format("<TIME_SLOT TIME_SLOT_ID=\"ts{}\" TIME_VALUE=\"{}\"/>\n", i, 100 * i);
  }
  text += "</TIME_ORDER>";
  if (odd && pick(3) == 0)
    text += "<OTHER><TIER TIER_ID='Gloss'><ANNOTATION_VALUE>odd</ANNOTATION_VALUE></TIER></OTHER>";
  const int tiers = pick(static_cast<int>(tier_names().size()));
  int id = 0;
  int below_first = 0;  // annotations of the first tier
  for (int t = 0; t < tiers; ++t) {
    const bool child = t > 0 && below_first > 0 && pick(2) == 0;
    text += blank();
    text += fmt::format("<TIER{}LINGUISTIC_TYPE_REF=\"{}\"{} TIER_ID{}\"{}\"", pick(2) == 0 ? " " : "\n  ",
                        child ? "tag" : "root",
                        child ? fmt::format(" PARENT_REF=\"{}\"", escaped_name(tier_names()[0])) : "",
                        pick(2) == 0 ? "=" : " = ", escaped_name(tier_names()[static_cast<std::size_t>(t)]));
    const int count = child ? pick(below_first + 1) : pick(slots);
    if (count == 0 && pick(2) == 0) {
      text += "/>";
      continue;
    }
    text += ">";
    for (int i = 0; i < count; ++i) {
      text += blank();
      if (child) {
        text += fmt::format("<ANNOTATION><REF_ANNOTATION ANNOTATION_ID=\"r{}\" ANNOTATION_REF=\"a{}\">", id++, i);
        text += fmt::format("<ANNOTATION_VALUE>{}</ANNOTATION_VALUE></REF_ANNOTATION></ANNOTATION>", label());
      } else {
        const int begin = count < slots ? i : 0;
        text += fmt::format(
            "<ANNOTATION >{}<ALIGNABLE_ANNOTATION ANNOTATION_ID='a{}' TIME_SLOT_REF1=\"ts{}\" "
            "TIME_SLOT_REF2=\"ts{}\">",
            pick(3) == 0 ? "\n  " : "", id++, begin, begin + 1);
        text += fmt::format("<ANNOTATION_VALUE>{}</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION\n>", label());
      }
    }
    if (t == 0) below_first = count;
    text += blank() + "</TIER>";
  }
  text += blank();
  text +=
      "<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"root\"/><LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"tag\" "
      "CONSTRAINTS=\"Symbolic_Association\"/>";
  return text + "</ANNOTATION_DOCUMENT>" + (pick(2) == 0 ? "\n" : "");
}

/// The same for ANVIL.
inline std::string anvil_text(bool odd) {
  std::string text = "<annotation>" + blank() + "<head><info key=\"a\">b</info></head>" + blank();
  if (odd && pick(3) == 0) text += "<other><track name='Gloss'><el index='0'/></track></other>";
  text += "<body>";
  const int tracks = pick(static_cast<int>(tier_names().size()));
  for (int t = 0; t < tracks; ++t) {
    text += blank();
    text += fmt::format("<track name=\"{}\" type=\"{}\"{}", escaped_name(tier_names()[static_cast<std::size_t>(t)]),
                        t == 1 ? "subdivision" : "primary", t == 1 ? " ref=\"Gloss\"" : "");
    const int count = t == 1 ? 0 : pick(6);
    if (count == 0 && pick(2) == 0) {
      text += "/>";
      continue;
    }
    text += ">";
    for (int i = 0; i < count; ++i) {
      text += blank() + fmt::format("<el index='{}' start='{}' end='{}'", i, i, i + 1);
      text += pick(3) == 0 ? "/>" : fmt::format("><attribute name='token'>{}</attribute></el>", label());
    }
    text += blank() + "</track>";
  }
  return text + "</body>" + blank() + "</annotation>\n";
}

}  // namespace signweave::testing_documents
