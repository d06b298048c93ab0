#pragma once

#include "engine/measure/stability/oracle_case.h"

namespace raylab::support {

using stability::Agreement;
using stability::compareWithOracle;
using stability::countDifferentHits;
using stability::flatten;
using stability::Flattened;
using stability::isDecidable;
using stability::isSameHit;
using stability::OracleCase;
using stability::oracleHits;

void expectAgreement(const Agreement& a, size_t rays);

}  // namespace raylab::support
