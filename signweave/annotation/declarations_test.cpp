#include "signweave/annotation/declarations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace signweave {
namespace {

using testing::ElementsAre;
using testing::Pair;

TEST(Declarations, OfADocumentAreItsPropertiesOfOurNames) {
  AnnotationDocument document;
  document.properties = {{"signweave:placeholder", "no signs"}, {"lastUsedAnnotationId", "4"}, {"signweave:x", "y"}};
  EXPECT_THAT(declarations_of(document),
              ElementsAre(Pair("signweave:placeholder", "no signs"), Pair("signweave:x", "y")));
}

TEST(Declarations, MergingKeepsEveryValueOfANameOnce) {
  Declarations all = {{"signweave:placeholder", "no signs"}};
  merge_declarations({{"signweave:placeholder", "no faces"}, {"signweave:placeholder", "no signs"}}, all);
  EXPECT_THAT(all, ElementsAre(Pair("signweave:placeholder", "no signs"), Pair("signweave:placeholder", "no faces")));
}

}  // namespace
}  // namespace signweave
