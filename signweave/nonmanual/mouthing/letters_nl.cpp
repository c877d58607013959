#include "signweave/nonmanual/mouthing/letters.h"

namespace signweave {
namespace {

constexpr std::string_view kRulesNl[] = {
    "[aai]=aːj", "[aa]=aː", "[auw]=ɑ͡u",  "[au]=ɑ͡u",    "[a]^#=aː",   "[a]_=aː",    "[a]=ɑ",    "[eeuw]=eːw", "[ee]=eː",
    "[ei]=ɛ͡i",   "[eu]=øː", "#:[en]_=ə", "#:[er]_=ər", "#:[el]_=əl", "_^[e]_=ə",   "#:[e]_=ə", "_g[e]^=ə",   "_b[e]^=ə",
    "[e]^#=eː",  "[e]=ɛ",   "[é]=eː",    "[è]=ɛ",      "[ë]=ə",      "l[ijk]_=ək", "[ij]=ɛ͡i",  "[ieuw]=iw",  "[ie]=i",
    "[i]=ɪ",     "[ï]=i",   "[ooi]=oːj", "[oo]=oː",    "[oei]=uj",   "[oe]=u",     "[ouw]=ɑ͡u", "[ou]=ɑ͡u",    "[o]^#=oː",
    "[o]=ɔ",     "[ö]=ø",   "[uw]=yw",   "[uu]=y",     "[ui]=œ͡y",    "[u]^#=y",    "[u]_=y",   "[u]=ʏ",      "[ü]=y",
    "[y]=i",     "[bb]=b",  "[b]=b",     "[ch]=x",     "[c]{eiy}=s", "[ck]=k",     "[c]=k",    "[ç]=s",      "[dt]=t",
    "[dd]=d",    "[d]=d",   "[ff]=f",    "[f]=f",      "[gg]=ɣ",     "[g]=ɣ",      "[h]=h",    "[j]=j",      "[kk]=k",
    "[k]=k",     "[ll]=l",  "[l]=l",     "[mm]=m",     "[m]=m",      "[ng]=ŋ",     "[nk]=ŋk",  "[nn]=n",     "[n]=n",
    "[ph]=f",    "[pp]=p",  "[p]=p",     "[qu]=kw",    "[q]=k",      "[rr]=r",     "[r]=r",    "[sch]_=s",   "[sch]=sx",
    "[sj]=ʃ",    "[ss]=s",  "[s]=s",     "[tie]_=tsi", "[tj]=tʃ",    "[th]=t",     "[tt]=t",   "[t]=t",      "[v]=v",
    "[w]=ʋ",     "[x]=ks",  "[zz]=z",    "[z]=z",
};

}  // namespace

std::span<const std::string_view> letter_rules_nl() noexcept {
  return kRulesNl;
}

}  // namespace signweave
