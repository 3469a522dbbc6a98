#pragma once

#include <string_view>

namespace relamp
{

/// The vector instructions a kernel is compiled for.
enum class InstructionSet { baseline, avx2, avx512 };

/// The widest set that this machine has. RELAMP_ISA=baseline|avx2|avx512 in the environment lowers
/// it, for tests and for hunting differences; it never raises it.
InstructionSet bestInstructionSet();

std::string_view nameOf(InstructionSet set);

#ifdef RELAMP_SANITIZED // looks at what the source does, and at one copy of it
#define RELAMP_TARGET_AVX2 gnu::noinline
#define RELAMP_TARGET_AVX512 gnu::noinline
#elif defined(__x86_64__) && !defined(__clang__)
#define RELAMP_TARGET_AVX2 gnu::target("avx2,fma,f16c"), gnu::flatten
#define RELAMP_TARGET_AVX512                                                                       \
    gnu::target("avx512f,avx512vl,avx512bw,avx512dq,fma,f16c,prefer-vector-width=512"), gnu::flatten
#elif defined(__x86_64__)
#define RELAMP_TARGET_AVX2 gnu::target("avx2,fma,f16c"), gnu::flatten
#define RELAMP_TARGET_AVX512                                                                       \
    gnu::target("avx512f,avx512vl,avx512bw,avx512dq,fma,f16c"), gnu::flatten
#else
#define RELAMP_TARGET_AVX2 gnu::flatten
#define RELAMP_TARGET_AVX512 gnu::flatten
#endif

template<auto kernel, class... Args>
[[RELAMP_TARGET_AVX2]] void runAvx2(Args&... args)
{
    kernel(args...);
}

template<auto kernel, class... Args>
[[RELAMP_TARGET_AVX512]] void runAvx512(Args&... args)
{
    kernel(args...);
}

/// Runs `kernel(args...)` compiled for `set`.
///
/// A kernel is a plain function over arrays. `flatten` pulls it, and all it calls, into a copy
/// built for the set, so that the loop in it is vectorised with that set's registers. There is one
/// source of it, and nothing compiled for a wide set can leak into code that runs on a narrow one.
template<auto kernel, class... Args>
void runKernel(InstructionSet set, Args&... args)
{
    switch (set) {
    case InstructionSet::avx512:
        return runAvx512<kernel>(args...);
    case InstructionSet::avx2:
        return runAvx2<kernel>(args...);
    case InstructionSet::baseline:
        return kernel(args...);
    }
}

} // namespace relamp
