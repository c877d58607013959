// A comment may name --unit, and so may "--unit" in it; `--count` is no option.
const char* kGuessed = "guessed; use --unit";
const char* kHelp = R"(
  the rest, with --full
)";
char kQuote = '"';  // --not-an-option
int less(int count) {
  return --count + (kGuessed == kHelp ? kQuote : 0);
}
