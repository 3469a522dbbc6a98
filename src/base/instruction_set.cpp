#include "base/instruction_set.h"

#include <algorithm>
#include <cstdlib>

namespace relamp
{
namespace
{

InstructionSet widestOfThisMachine()
{
#if defined(__x86_64__)
    __builtin_cpu_init();
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq");
    if (avx2 && avx512) return InstructionSet::avx512;
    if (avx2) return InstructionSet::avx2;
#endif
    return InstructionSet::baseline;
}

InstructionSet widestAllowed()
{
    const char* wish = std::getenv("RELAMP_ISA");
    if (wish == nullptr) return InstructionSet::avx512;
    if (std::string_view(wish) == "baseline") return InstructionSet::baseline;
    if (std::string_view(wish) == "avx2") return InstructionSet::avx2;
    return InstructionSet::avx512;
}

} // namespace

InstructionSet bestInstructionSet()
{
    static const InstructionSet best = std::min(widestOfThisMachine(), widestAllowed());
    return best;
}

std::string_view nameOf(InstructionSet set)
{
    switch (set) {
    case InstructionSet::avx512:
        return "avx512";
    case InstructionSet::avx2:
        return "avx2";
    case InstructionSet::baseline:
        break;
    }
    return "baseline";
}

} // namespace relamp
