/* cpu.c - see cpu.h. */
#include "base/cpu.h"

#include <stdlib.h>
#include <string.h>

static const char *const names[N_CPU_ISAS] = { "base", "avx2", "avx512" };

static CpuIsa found(void)
{
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (!__builtin_cpu_supports("avx2"))
        return CPU_BASE;
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512bw"))
        return CPU_AVX512;
    return CPU_AVX2;
#else
    return CPU_BASE;
#endif
}

CpuIsa cpu_isa(void)
{
    CpuIsa best = found();
    const char *wanted = getenv("WHIT_CPU");
    for (int i = 0; wanted != NULL && i <= (int)best; i++)
        if (strcmp(wanted, names[i]) == 0)
            return (CpuIsa)i;
    return best;
}

const char *cpu_isa_name(CpuIsa isa)
{
    return names[isa];
}
