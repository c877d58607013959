#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "signweave/formats/eaf/elements.h"
#include "signweave/formats/eaf/test_support.h"

/// For any document and any changes: what is written reads as intended, and nothing else changes.
namespace signweave::eaf {
namespace {

using namespace testing_support;

int whole_number(int from, int below) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(from, below));  // small documents prove little
}

bool chance(int percent) {
  return whole_number(0, 100) < percent;
}

std::string any_label() {
  return *rc::gen::element<std::string>("VANNES", "", " ", "MÉTÉO ", "<&>\"'", "手話", "a\r\nb\tc", "]]>", "&amp;", "é",
                                        "e\u0301", "👋🏽", "شكرا", "&#38;", "<!-- -->");
}

/// Builds a document whose every span and mark is what its file will contain.
class Builder {
 public:
  AnnotationDocument build() {
    document_.author = any_label();
    document_.date = "2026-01-02T03:04:05Z";
    for (int i = whole_number(0, 3); i > 0; --i) {
      document_.linked_files.push_back(
          {any_label(), any_label(), any_label(), Milliseconds(whole_number(-9, 9)), i > 1});
    }
    for (int i = whole_number(0, 3); i > 0; --i)
      document_.properties.emplace_back("p" + std::to_string(i), any_label());
    document_.properties.emplace_back(std::string(kLastUsedAnnotationId), "900");
    constexpr Stereotype kAll[] = {Stereotype::none, Stereotype::time_subdivision, Stereotype::included_in,
                                   Stereotype::symbolic_subdivision, Stereotype::symbolic_association};
    for (const Stereotype stereotype : kAll) {
      document_.types.push_back({"type " + std::to_string(static_cast<int>(stereotype)), stereotype, any_label()});
    }
    const int tiers = whole_number(0, 9);
    for (int i = 0; i < tiers; ++i) {
      add_tier(i == 0 || chance(30) ? kNone : static_cast<std::size_t>(whole_number(0, i)));
    }
    return document_;
  }

 private:
  /// Which bounds have times, in addition to the annotation itself.
  struct Bounds {
    bool begin = true;
    bool end = true;
  };

  void add_tier(std::size_t parent) {
    Stereotype stereotype = Stereotype::none;
    if (parent != kNone)
      stereotype = static_cast<Stereotype>(whole_number(is_symbolic(stereotypes_[parent]) ? 3 : 1, 5));
    Tier tier;
    tier.id = "tier " + std::to_string(document_.tiers.size()) + (chance(30) ? any_label() : "");
    tier.type = "type " + std::to_string(static_cast<int>(stereotype));
    tier.participant = any_label();
    tier.annotator = any_label();
    tier.language = chance(30) ? any_label() : "";
    document_.tiers.push_back(tier);
    stereotypes_.push_back(stereotype);
    bounds_.emplace_back();
    if (parent == kNone) {
      fill({0ms, 5000ms}, "", true);
      return;
    }
    document_.tiers.back().parent = document_.tiers[parent].id;
    for (std::size_t i = 0; i < document_.tiers[parent].annotations.size(); ++i) {
      const Annotation above = document_.tiers[parent].annotations[i];
      if (chance(20)) continue;
      if (stereotype == Stereotype::included_in) fill(above.span, above.id, above.aligned);
      if (stereotype == Stereotype::time_subdivision) subdivide(above, bounds_[parent][i]);
      if (stereotype == Stereotype::symbolic_association) add(above.span, above.id, {false, false});
      if (stereotype == Stereotype::symbolic_subdivision) divide(above);
    }
  }

  void add(TimeSpan span, const std::string& parent, Bounds bounds) {
    const std::string id = (chance(20) ? "é" : "a") + std::to_string(++ids_);
    document_.tiers.back().annotations.push_back({id, any_label(), span, parent, bounds.begin && bounds.end});
    bounds_.back().push_back(bounds);
  }

  /// Adds annotations with times of their own, with and without gaps, some of zero length.
  void fill(TimeSpan whole, const std::string& parent, bool no_length_too) {
    Milliseconds at = whole.begin;
    for (int i = whole_number(0, 12); i > 0; --i) {
      const Milliseconds begin = at + Milliseconds(chance(50) ? 0 : whole_number(0, 100));
      const Milliseconds end = begin + Milliseconds(no_length_too && chance(10) ? 0 : whole_number(1, 400));
      if (end > whole.end) return;
      add({begin, end}, parent, {});
      at = end;
    }
  }

  void subdivide(const Annotation& above, Bounds outer) {
    const int count = whole_number(1, 5);
    const std::int64_t length = above.span.duration().count();
    std::vector<std::int64_t> cuts{0};
    const bool aligned = chance(60) || length < count;
    for (int i = 1; i < count; ++i) {
      cuts.push_back(aligned ? whole_number(0, static_cast<int>(length) + 1) : i * (length / count));
    }
    cuts.push_back(length);
    std::sort(cuts.begin(), cuts.end());
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const TimeSpan span{above.span.begin + Milliseconds(cuts[at]), above.span.begin + Milliseconds(cuts[at + 1])};
      add(span, above.id, {i == 0 ? outer.begin : aligned, i + 1 == count ? outer.end : aligned});
    }
  }

  void divide(const Annotation& above) {
    const int count = whole_number(1, 5);
    const double part = static_cast<double>(above.span.duration().count()) / count;
    const auto bound = [&](int i) {
      return i == count ? above.span.end : above.span.begin + Milliseconds(static_cast<std::int64_t>(i * part));
    };
    for (int i = 0; i < count; ++i) add({bound(i), bound(i + 1)}, above.id, {false, false});
  }

  AnnotationDocument document_;
  std::vector<Stereotype> stereotypes_;
  std::vector<std::vector<Bounds>> bounds_;
  int ids_ = 0;
};

void assert_same(const AnnotationDocument& read, const AnnotationDocument& meant, const std::string& text) {
  if (without_source(read) == without_source(meant)) return;
  RC_LOG() << testing::PrintToString(without_source(read)) << "\nwhere this was meant:\n"
           << testing::PrintToString(without_source(meant)) << "\n"
           << text;
  RC_FAIL("it reads as another document");
}

RC_GTEST_PROP(EafProperty, AMadeDocumentComesBack, ()) {
  const AnnotationDocument document = Builder().build();
  const std::string text = write_text(document);
  const File file = read_text("made.eaf", text);
  assert_same(file.document, document, text);
  RC_ASSERT(write_text(file.document) == text);
}

/// Changes a document at random, and remembers the tiers it touched.
class Changer {
 public:
  explicit Changer(AnnotationDocument& document) : document_(document) {}

  void change() {
    switch (whole_number(0, 9)) {
      case 0:
        change_label();
        break;
      case 1:
        remove_annotation();
        break;
      case 2:
        add_annotation();
        break;
      case 3:
        move_annotation();
        break;
      case 4:
        move_boundary();
        break;
      case 5:
        change_tier();
        break;
      case 6:
        remove_tier();
        break;
      case 7:
        add_tier();
        break;
      default:
        change_head();
    }
  }

  const std::set<std::string>& touched() const { return touched_; }

 private:
  Tier* any_tier() {
    if (document_.tiers.empty()) return nullptr;
    return &document_.tiers[static_cast<std::size_t>(whole_number(0, static_cast<int>(document_.tiers.size())))];
  }

  Annotation* any_annotation(Tier* tier) {
    if (tier == nullptr || tier->annotations.empty()) return nullptr;
    return &tier->annotations[static_cast<std::size_t>(whole_number(0, static_cast<int>(tier->annotations.size())))];
  }

  bool has_children(const std::string& id) const {
    return std::any_of(document_.tiers.begin(), document_.tiers.end(), [&](const Tier& tier) {
      return std::any_of(tier.annotations.begin(), tier.annotations.end(),
                         [&](const Annotation& one) { return one.parent == id; });
    });
  }

  Stereotype stereotype(const Tier& tier) const { return document_.find_type(tier.type)->stereotype; }

  void change_label() {
    Tier* tier = any_tier();
    Annotation* one = any_annotation(tier);
    if (one == nullptr) return;
    one->label = any_label();
    touched_.insert(tier->id);
  }

  void remove_with_children(std::set<std::string> ids) {
    while (!ids.empty()) {
      std::set<std::string> next;
      for (Tier& tier : document_.tiers) {
        const auto gone = [&](const Annotation& one) { return ids.contains(one.id); };
        for (const Annotation& one : tier.annotations) {
          if (ids.contains(one.parent)) next.insert(one.id);
        }
        if (std::erase_if(tier.annotations, gone) > 0) touched_.insert(tier.id);
      }
      ids = std::move(next);
    }
  }

  void remove_annotation() {
    Tier* tier = any_tier();
    const Annotation* one = any_annotation(tier);
    if (one == nullptr) return;
    std::set<std::string> ids{one->id};
    if (!one->aligned) {  // the times of its siblings depend on it
      for (const Annotation& other : tier->annotations) {
        if (other.parent == one->parent) ids.insert(other.id);
      }
    }
    remove_with_children(ids);
  }

  void add_annotation() {
    Tier* tier = any_tier();
    if (tier == nullptr || stereotype(*tier) != Stereotype::none) return;
    const Milliseconds begin = tier->annotations.empty() ? 0ms : tier->annotations.back().span.end;
    tier->annotations.push_back({new_id(), any_label(), {begin, begin + Milliseconds(whole_number(1, 99))}, "", true});
    touched_.insert(tier->id);
  }

  /// Shortens the span of an annotation on which no other depends.
  void move_annotation() {
    Tier* tier = any_tier();
    Annotation* one = any_annotation(tier);
    if (one == nullptr || has_children(one->id) || one->span.duration() < 10ms) return;
    if (stereotype(*tier) != Stereotype::none && stereotype(*tier) != Stereotype::included_in) return;
    one->span.begin += Milliseconds(whole_number(0, 4));
    one->span.end -= Milliseconds(whole_number(0, 4));
    touched_.insert(tier->id);
  }

  void move_boundary() {
    Tier* tier = any_tier();
    if (tier == nullptr || stereotype(*tier) != Stereotype::time_subdivision) return;
    for (std::size_t i = 1; i < tier->annotations.size(); ++i) {
      Annotation& left = tier->annotations[i - 1];
      Annotation& right = tier->annotations[i];
      const bool joined = left.parent == right.parent && left.span.end == right.span.begin;
      if (!joined || !left.aligned || !right.aligned || right.span.duration() < 10ms || chance(50)) continue;
      if (has_children(left.id) || has_children(right.id)) continue;
      left.span.end = right.span.begin = left.span.end + Milliseconds(whole_number(1, 9));
      touched_.insert(tier->id);
    }
  }

  void change_tier() {
    if (Tier* tier = any_tier()) {
      tier->participant = any_label();
      if (chance(30)) tier->language = "zz";
      touched_.insert(tier->id);
    }
  }

  void remove_tier() {
    const Tier* tier = any_tier();
    if (tier == nullptr) return;
    std::set<std::string> gone{tier->id};
    for (std::size_t before = 0; before != gone.size();) {
      before = gone.size();
      for (const Tier& other : document_.tiers) {
        if (gone.contains(other.parent)) gone.insert(other.id);
      }
    }
    std::erase_if(document_.tiers, [&](const Tier& other) { return gone.contains(other.id); });
  }

  void add_tier() {
    Tier tier{new_id(), "type 0", "", "", "", "", {}};
    touched_.insert(tier.id);
    const Tier* parent = any_tier();
    if (parent != nullptr && chance(70)) {  // a copy of its parent
      tier.parent = parent->id;
      tier.type = "type 4";
      for (const Annotation& one : parent->annotations) {
        tier.annotations.push_back({new_id(), any_label(), one.span, one.id, false});
      }
    }
    const auto at = static_cast<std::ptrdiff_t>(whole_number(0, static_cast<int>(document_.tiers.size()) + 1));
    document_.tiers.insert(document_.tiers.begin() + at, tier);
  }

  void change_head() {
    if (chance(30)) document_.author = any_label();
    if (chance(30)) document_.properties.insert(document_.properties.begin(), {"new", any_label()});
    if (chance(30) && document_.properties.size() > 1) document_.properties[0].second = any_label();
    if (chance(30)) document_.linked_files.push_back({any_label(), "", any_label(), 7ms, chance(50)});
    if (chance(30) && !document_.linked_files.empty()) document_.linked_files.erase(document_.linked_files.begin());
    if (chance(30)) document_.types.insert(document_.types.begin(), {new_id(), Stereotype::included_in, ""});
    if (chance(20)) std::reverse(document_.types.begin(), document_.types.end());
  }

  std::string new_id() { return "n" + std::to_string(++ids_); }

  AnnotationDocument& document_;
  std::set<std::string> touched_;
  int ids_ = 0;
};

/// The bytes of each tier, found by its position, because names may contain anything.
std::map<std::string, std::string> tiers_by_name(const std::string& text, const AnnotationDocument& document) {
  std::map<std::string, std::string> result;
  std::size_t at = 0;
  for (const Tier& tier : document.tiers) {
    at = text.find("<TIER ", at);
    const std::size_t next = std::min(text.find("<TIER ", at + 1), text.find("<LINGUISTIC_TYPE ", at + 1));
    const std::size_t end = text.rfind('>', next) + 1;
    result[tier.id] = text.substr(at, end - at);
    at = end;
  }
  return result;
}

/// Adds elements and attributes that we do not model, where ELAN writes them.
std::string with_foreign_parts(std::string text) {
  const auto put = [&](std::string_view before, std::string_view what) {
    for (std::size_t at = 0; (at = text.find(before, at)) != std::string::npos; at += before.size() + what.size()) {
      if (chance(50)) text.insert(at + before.size(), what);
    }
  };
  put("<ALIGNABLE_ANNOTATION", " EXT_REF=\"er1\"");
  put("<REF_ANNOTATION", " CVE_REF='cve1'");
  put("<ANNOTATION_VALUE", " LANG=\"x\"");
  put("<TIER", " DEFAULT_LOCALE=\"fr\"");
  put("</ANNOTATION>", "<!-- a <comment> -->");
  put("<TIME_ORDER>", "<?some thing?>");
  put("</HEADER>", "\n\n    <STRANGE A='>'/>");
  return text;
}

RC_GTEST_PROP(EafProperty, ChangesSurviveAndNothingElseChanges, ()) {
  const std::string text = with_foreign_parts(write_text(Builder().build()));
  const AnnotationDocument before = read_text("before.eaf", text).document;
  AnnotationDocument after = before;
  Changer changer(after);
  for (int i = whole_number(1, 5); i > 0; --i) changer.change();

  const std::string written = write_text(after);
  const File again = read_text("after.eaf", written);
  assert_same(again.document, after, written);
  const std::map<std::string, std::string> old_bytes = tiers_by_name(text, before);
  for (const auto& [name, bytes] : tiers_by_name(written, after)) {
    if (changer.touched().contains(name)) continue;
    RC_ASSERT(bytes == old_bytes.at(name));
  }
  for (const char* foreign : {"<?some thing?>", "<STRANGE A='>'/>"}) {
    RC_ASSERT((text.find(foreign) == std::string::npos) == (written.find(foreign) == std::string::npos));
  }
}

}  // namespace
}  // namespace signweave::eaf
