#pragma once

#include "common/facts.h"

/// Object of members of a struct by their own names: of FACTS_OF(mode, frequency, direction) they
/// are "frequency" and "direction".
#define FACTS_OF(owner, ...) pounding::Json::object({FACTS_EXPAND(FACTS_NEXT(owner, __VA_ARGS__))})
#define FACTS_NEXT(owner, member, ...) \
  {#member, owner.member}, __VA_OPT__(FACTS_AGAIN FACTS_LATER(owner, __VA_ARGS__))
#define FACTS_AGAIN() FACTS_NEXT
#define FACTS_LATER ()
#define FACTS_EXPAND(...) FACTS_THRICE(FACTS_THRICE(FACTS_THRICE(__VA_ARGS__)))
#define FACTS_THRICE(...) FACTS_ONCE(FACTS_ONCE(FACTS_ONCE(__VA_ARGS__)))
#define FACTS_ONCE(...) __VA_ARGS__
