#include "tests/support/trace_oracle.h"

#include <gtest/gtest.h>

namespace raylab::support {

void expectAgreement(const Agreement& a, size_t rays) {
    EXPECT_EQ(a.wrongHits, 0u);
    EXPECT_EQ(a.wrongDistances, 0u);
    EXPECT_EQ(a.wrongShadows, 0u);
    EXPECT_GT(a.decidable, rays * 3 / 4) << "too few rays left to mean anything";
    EXPECT_GT(a.hits, rays / 20);
}

}  // namespace raylab::support
