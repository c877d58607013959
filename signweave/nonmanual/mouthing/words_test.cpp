#include <gtest/gtest.h>

#include <string>

#include "signweave/nonmanual/mouthing/pronounce.h"

namespace signweave {
namespace {

struct Word {
  const char* text;
  const char* ipa;      ///< as dictionaries give it; for letters: empty
  const char* visemes;  ///< separated by blanks
};

std::string visemes_of(const std::vector<Phone>& phones) {
  std::string text;
  for (const Phone& phone : phones) text += std::string(text.empty() ? "" : " ") + std::string(name_of(phone.viseme));
  return text;
}

constexpr Word kIpaWords[] = {
    {"bonjour", "bɔ̃ʒˈuʁ", "PP O CH U kk"},
    {"demain", "dəmˈɛ̃", "DD E PP E"},
    {"pluie", "plɥˈi", "PP nn Y I"},
    {"soleil", "sɔlˈɛj", "SS O nn E I"},
    {"neige", "nˈɛʒ", "nn E CH"},
    {"rue", "ʁˈy", "kk Y"},
    {"peu", "pˈø", "PP OE"},
    {"peur", "pˈœʁ", "PP OE kk"},
    {"brun", "bʁˈœ̃", "PP kk OE"},
    {"huit", "ˈɥit", "Y I DD"},
    {"oui", "wˈi", "U I"},
    {"montagne", "mɔ̃tˈaɲ", "PP O DD aa nn"},
    {"fille", "fˈij", "FF I I"},
    {"château", "ʃatˈo", "CH aa DD O"},
    {"vent", "vˈɑ̃", "FF aa"},
    {"chat", "ʃˈa", "CH aa"},
    {"question", "kɛstjˈɔ̃", "kk E SS DD I O"},
    {"famille", "famˈij", "FF aa PP I I"},
    {"zéro", "zeʁˈo", "SS E kk O"},
    {"lune", "lˈyn", "nn Y nn"},
    {"rain", "ɹˈe\u200dɪn", "RR E I nn"},
    {"good morning", "ɡˈʊd mˈɔːnɪŋ", "kk U DD PP O nn I nn"},
    {"church", "tʃˈɜːtʃ", "CH E CH"},
    {"judge", "d\u200dʒˈʌd\u200dʒ", "CH aa CH"},
    {"think", "θˈɪŋk", "TH I nn kk"},
    {"weather", "wˈɛðə", "U E TH E"},
    {"house", "hˈa\u200dʊs", "aa U SS"},
    {"happy", "hˈapi", "aa PP I"},
    {"voice", "vˈɔ\u200dɪs", "FF O I SS"},
    {"snow", "snˈə\u200dʊ", "SS nn E U"},
    {"three", "θɹˈiː", "TH RR I"},
    {"ship", "ʃˈɪp", "CH I PP"},
    {"vision", "vˈɪʒən", "FF I CH E nn"},
    {"yes", "jˈɛs", "I E SS"},
    {"queen", "kwˈiːn", "kk U I nn"},
    {"thumb", "θˈʌm", "TH aa PP"},
    {"cat", "kˈæt", "kk aa DD"},
    {"go", "ɡˈo\u0361ʊ", "kk O U"},
    {"dog", "dˈɒɡ", "DD O kk"},
    {"bird", "bˈɜːd", "PP E DD"},
};

TEST(Ipa, WordsBecomeTheirVisemes) {
  for (const Word& word : kIpaWords) EXPECT_EQ(visemes_of(phones_of_ipa(word.ipa)), word.visemes) << word.text;
  EXPECT_EQ(std::size(kIpaWords), 40U);
}

std::string read(const char* text, MouthingLanguage language) {
  Pronouncer pronouncer({.language = language});
  return visemes_of(pronouncer.pronounce(text, "test").phones);
}

TEST(Letters, ReadFrench) {
  constexpr Word kWords[] = {
      {"pluie", "", "PP nn Y I"},
      {"soleil", "", "SS O nn E I"},
      {"aujourd'hui", "", "O CH U kk DD Y I"},
      {"beaucoup", "", "PP O kk U"},
      {"travailler", "", "DD kk aa FF aa I E"},
      {"montagne", "", "PP O DD aa nn"},
      {"température", "", "DD aa PP E kk aa DD Y kk"},
      {"femme", "", "FF aa PP"},
      {"oiseau", "", "U aa SS O"},
      {"vingt", "", "FF E"},
      {"grenouille", "", "kk kk E nn U I"},
      {"éclaircie", "", "E kk nn E kk SS I"},
      {"garçon", "", "kk aa kk SS O"},
      {"deux", "", "DD OE"},
  };
  for (const Word& word : kWords) EXPECT_EQ(read(word.text, MouthingLanguage::fr), word.visemes) << word.text;
}

TEST(Letters, ReadEnglish) {
  constexpr Word kWords[] = {
      {"rain", "", "RR E I nn"},    {"make", "", "PP E I kk"},        {"light", "", "nn aa I DD"},
      {"weather", "", "U E TH E"},  {"nation", "", "nn E I CH E nn"}, {"knife", "", "nn aa I FF"},
      {"phone", "", "FF O U nn"},   {"people", "", "PP I PP E nn"},   {"church", "", "CH E CH"},
      {"school", "", "SS kk U nn"}, {"happy", "", "aa PP I"},         {"two", "", "DD U"},
  };
  for (const Word& word : kWords) EXPECT_EQ(read(word.text, MouthingLanguage::en), word.visemes) << word.text;
}

TEST(Letters, ReadGerman) {
  constexpr Word kWords[] = {
      {"Schnee", "", "CH nn E"},  {"Sonne", "", "SS O nn E"},         {"zwölf", "", "DD SS FF OE nn FF"},
      {"Wein", "", "FF aa I nn"}, {"spielen", "", "CH PP I nn E nn"}, {"Bücher", "", "PP Y kk aa"},
      {"heute", "", "O Y DD E"},  {"Pferd", "", "PP FF E kk DD"},     {"Straße", "", "CH DD kk aa SS E"},
  };
  for (const Word& word : kWords) EXPECT_EQ(read(word.text, MouthingLanguage::de), word.visemes) << word.text;
}

TEST(Letters, ReadDutch) {
  constexpr Word kWords[] = {
      {"goed", "", "kk U DD"},  {"huis", "", "OE Y SS"},      {"vrouw", "", "FF RR aa U"},    {"tijd", "", "DD E I DD"},
      {"deur", "", "DD OE RR"}, {"school", "", "SS kk O nn"}, {"water", "", "FF aa DD E RR"},
  };
  for (const Word& word : kWords) EXPECT_EQ(read(word.text, MouthingLanguage::nl), word.visemes) << word.text;
}

TEST(Letters, ReadEveryNormalFormAndCase) {
  EXPECT_EQ(read("e\u0301toile", MouthingLanguage::fr), read("\u00e9toile", MouthingLanguage::fr));
  EXPECT_EQ(read("ÉTOILE", MouthingLanguage::fr), read("étoile", MouthingLanguage::fr));
  EXPECT_EQ(read("l\u2019eau", MouthingLanguage::fr), "nn O");
  EXPECT_EQ(read("Zürich", MouthingLanguage::en), read("Zurich", MouthingLanguage::en));
}

}  // namespace
}  // namespace signweave
