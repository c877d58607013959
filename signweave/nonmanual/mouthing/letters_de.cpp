#include "signweave/nonmanual/mouthing/letters.h"

namespace signweave {
namespace {

constexpr std::string_view kRulesDe[] = {
    "[aa]=aː",      "[ah]^=aː",    "[ah]_=aː",   "[ai]=a͡ɪ",    "[ay]=a͡ɪ",   "[au]=a͡ʊ",       "[a]=a",    "[äu]=ɔ͡ʏ",
    "[äh]^=ɛː",     "[ä]=ɛ",       "[ei]=a͡ɪ",    "[ey]=a͡ɪ",    "[eu]=ɔ͡ʏ",   "[ee]=eː",       "[eh]^=eː", "[eh]_=eː",
    "#:[er]_=ɐ",    "#:[ern]_=ɐn", "#:[en]_=ən", "#:[el]_=əl", "#:[e]_=ə",  "_g[e]^=ə",      "_b[e]^=ə", "[e]=ɛ",
    "[é]=e",        "#:[ig]_=ɪç",  "[ieh]=iː",   "[ie]=iː",    "[ih]=iː",   "[i]=ɪ",         "[oo]=oː",  "[oh]^=oː",
    "[oh]_=oː",     "[o]=ɔ",       "[öh]=øː",    "[ö]=œ",      "[uh]^=uː",  "[uh]_=uː",      "[u]=ʊ",    "[üh]=yː",
    "[ü]=ʏ",        "[y]=ʏ",       "[bb]=b",     "[b]=b",      "[chs]=ks",  "{aou}[ch]=x",   "[ch]=ç",   "[ck]=k",
    "[c]{eiäy}=ts", "[c]=k",       "[dt]=t",     "[dd]=d",     "[d]=d",     "[ff]=f",        "[f]=f",    "[gg]=ɡ",
    "[g]=ɡ",        "[h]=h",       "[j]=j",      "[kk]=k",     "[k]=k",     "[ll]=l",        "[l]=l",    "[mm]=m",
    "[m]=m",        "[ng]=ŋ",      "[nk]=ŋk",    "[nn]=n",     "[n]=n",     "[pf]=pf",       "[ph]=f",   "[pp]=p",
    "[p]=p",        "[qu]=kv",     "[q]=k",      "[rr]=ʁ",     "[r]=ʁ",     "[sch]=ʃ",       "_[sp]=ʃp", "_[st]=ʃt",
    "[ss]=s",       "[s]#=z",      "[s]=s",      "[ß]=s",      "[tsch]=tʃ", "[tion]=tsjoːn", "[th]=t",   "[tz]=ts",
    "[tt]=t",       "[t]=t",       "[v]=f",      "[w]=v",      "[x]=ks",    "[zz]=ts",       "[z]=ts",
};

}  // namespace

std::span<const std::string_view> letter_rules_de() noexcept {
  return kRulesDe;
}

}  // namespace signweave
