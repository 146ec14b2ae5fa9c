/* cpu.h - which instruction set the kernels use, and how a kernel's names carry it.
 *
 * Files named *_kernel.c are compiled once per instruction set with -DISA=base (avx2, avx512). Such a file defines
 * ISA_NAME(walk), which becomes walk_base, walk_avx2...; its caller lists them with CPU_TABLE:
 *
 *     #define DECLARE(isa) Walk walk_##isa;
 *     CPU_ISAS(DECLARE)
 *     static Walk *const walks[] = CPU_TABLE(walk);        walks[cpu_isa()](...)
 *
 * All rows give the same bits; only time differs. */
#ifndef BASE_CPU_H
#define BASE_CPU_H

typedef enum CpuIsa { CPU_BASE, CPU_AVX2, CPU_AVX512, N_CPU_ISAS } CpuIsa;

/* The best that this machine has, or the one that the environment names in WHIT_CPU (base, avx2, avx512) if it has it. */
CpuIsa cpu_isa(void);
const char *cpu_isa_name(CpuIsa isa);

#define ISA_NAME(name) CPU_PASTE(name, ISA)
#define CPU_PASTE(name, isa) CPU_PASTE_AGAIN(name, isa)
#define CPU_PASTE_AGAIN(name, isa) name##_##isa

#if defined(__x86_64__)
#define CPU_ISAS(ROW) ROW(base) ROW(avx2) ROW(avx512)
#define CPU_TABLE(name) { [CPU_BASE] = name##_base, [CPU_AVX2] = name##_avx2, [CPU_AVX512] = name##_avx512 }
#else
#define CPU_ISAS(ROW) ROW(base)
#define CPU_TABLE(name) { [CPU_BASE] = name##_base, [CPU_AVX2] = name##_base, [CPU_AVX512] = name##_base }
#endif

#endif
